"""The dictionary describes every variable of the datasets, and no other."""

import xarray as xr
from dataset_pages import SHARED, described_rows, made_variables
from refusals import assert_says, refusal

from hardcontact.report.dataset_dictionary import rows_of


def test_the_dictionary_describes_exactly_the_variables_of_the_study(results):
    page, variables = described_rows(), made_variables(results)
    assert variables.keys() <= page.keys()
    for name, rows in variables.items():
        assert rows <= page[name] if name in SHARED else rows == page[name], name


def test_the_meaning_for_one_dataset_overrides_the_long_name_and_this_the_general_meaning():
    attributes = {"units": "N", "long_name": "long name"}
    data = xr.Dataset(
        {name: ("x", [1.0], attributes) for name in ("own", "named", "named_interval")}
    )
    known_meanings = {("a", "own"): "Own.", ("*", "named"): "For all.", ("*", "x"): "Axis."}
    rows = rows_of("a", data.assign_coords(x=[0]), known_meanings)
    assert rows == {
        "`own`": ("x", "N", "Own."),
        "`named` \\*": ("x", "N", "Long name."),
        "`x`": ("x", "", "Axis."),
    }


def test_a_variable_without_a_meaning_is_refused():
    line = refusal(rows_of, "a", xr.Dataset({"force": 1.0}), {})
    assert_says(line, "variables.tsv: expected", "a `force`")
