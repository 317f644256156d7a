"""Notes of an answer become JSON."""

import json

import numpy as np

from hardcontact.report.answer import note


def test_the_gravity_of_a_note_may_come_from_a_comparison_of_numpy():
    written = json.loads(json.dumps(note("caution", "Few pixels.", grave=np.float64(0.5) < 0.9)))
    assert written["grave"] is True
