"""Numbers about classical models, of errors and works that are known."""

import numpy as np
from paper_claims import near
from paper_datasets import make_classical, make_inference

from hardcontact.claims.contact_quantities import classical_over_numerical, effective_work_decades


def test_classical():
    classical = make_classical()
    spread = effective_work_decades(classical).sel(against="computed")
    near(spread, [np.log10(7.15 / 0.08)] * 3)
    ratio = classical_over_numerical(classical, make_inference())
    near(ratio.sel(contact_model="plastic", model="maugis", against="published"), [12, 12])
    best = ratio.sel(contact_model="plastic", model="maugis", against="published", metrics="afm")
    np.testing.assert_allclose(best["value_interval"], [0.54 / 0.0505, 0.66 / 0.0495])
