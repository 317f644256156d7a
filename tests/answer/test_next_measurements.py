"""What would narrow an answer: ranked by what it leaves, nothing of what was never drawn."""

import numpy as np
from answer_inputs import SURFACES, datasets, fit, force

from hardcontact.answer.next_measurements import next_measurements
from hardcontact.insight.next_measurement import OUTCOMES


def proposed(own=None, **others):
    """All that is proposed, by code, in its order, with the shares left in percent."""
    of = datasets(**others).of_surface(SURFACES[0])._replace(fit=own)
    return {
        one["code"]: {name: number.value for name, number in one["left"].items()}
        for one in next_measurements(of)
    }


def test_measurements_are_ranked_by_the_widths_that_they_leave():
    found = proposed()
    assert next(iter(found)) == "now" and np.isnan(found.pop("now")["force"])
    assert all(set(left) == set(OUTCOMES) for left in found.values())
    products = [np.prod([share for share in left.values()]) for left in found.values()]
    assert products == sorted(products)
    assert found["finer_map"]["short_edge"] < 80 and found["coating"]["range"] < 50


def test_own_forces_are_proposed_once_and_tell_the_force():
    without, tested = proposed(), proposed(own=fit())
    assert without["forces"]["force"] < 20 and "forces" not in tested
    assert tested["finer_map"]["force"] > without["finer_map"]["force"]


def test_of_a_surface_without_scans_nothing_is_proposed():
    assert not proposed(force=force().drop_vars("true_outcome"))
    assert not proposed(force=force().assign(true_outcome=force()["true_outcome"] * np.nan))
