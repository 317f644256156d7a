"""The sphere and the roughness that the paper prints, as classical models take them."""

import numpy as np
from paper_numbers import TABLE1

from hardcontact.contact.smooth_sphere import effective_modulus
from hardcontact.paper.classical_models import ElasticSphere, Roughness

RADIUS, SPACING, WORK = 250e3, 0.3, 0.0463
MODULUS = effective_modulus(
    {"modulus": 365e9, "poisson_ratio": 0.29}, {"modulus": 1010e9, "poisson_ratio": 0.22}
)
SPHERE = ElasticSphere(RADIUS, MODULUS, SPACING)
AFM, UNCERTAINTY = (
    Roughness(*(np.array(TABLE1[f"afm_rms_{name}"][column]) for name in Roughness._fields))
    for column in (0, 1)
)
