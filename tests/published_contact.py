"""The contact and the roughness that the paper prints, as classical models take them."""

import numpy as np
from paper_numbers import TABLE1

from hardcontact.contact import hertz
from hardcontact.inference.classical_models import Contact, Roughness

RADIUS, SPACING, WORK = 250e3, 0.3, 0.0463
MODULUS = hertz.effective_modulus(365e9, 0.29, 1010e9, 0.22)
CONTACT = Contact(RADIUS, MODULUS, SPACING)
AFM, UNCERTAINTY = (
    Roughness(*(np.array(TABLE1[f"afm_rms_{name}"][column]) for name in Roughness._fields))
    for column in (0, 1)
)
