"""Experiments of which all is known, but what a test leaves open."""

from hardcontact.insight.experiments import Cell, Experiment

KNOWN = {
    "radius_nm": 1e5, "rms_height_nm": 4.0, "rolloff_nm": 1000.0, "hurst": 0.8,
    "shortest_nm": 20.0, "preload_nN": 400.0, "hardness_GPa": 1.0, "range_nm": 5.6,
}  # fmt: skip


def experiment(statement, rough=None, **given):
    """Return an experiment; a pair given for one of KNOWN is a range, `rough` the second height."""
    known = KNOWN | {name: given.pop(name) for name in KNOWN if name in given}
    known["rougher_rms_height_nm"] = rough or float("nan")
    ends = {name: one if isinstance(one, tuple) else (one, one) for name, one in known.items()}
    about = {
        "id": "one", "label": "One", "materials": "ruby on diamond", "contact": "hard",
        "statement": statement, "rule": "interval", "measured": 1.0, "low": 0.5, "high": 2.0,
    }  # fmt: skip
    cells = {name: Cell("stated", *both) for name, both in ends.items()}
    return Experiment(**(about | given), cells=cells)
