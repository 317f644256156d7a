"""Every variable of a finished study has a unit and a meaning, and the list shows them."""

import pytest
import xarray as xr
from comparison import undescribed_variables

from hardcontact.base.dataset import describe_variables, read_meanings


def test_variables_are_described_and_others_keep_their_names():
    named = xr.DataArray(1.0, attrs={"units": "N", "long_name": "Own."})
    data = xr.Dataset({"force": 1.0, "force_interval": 2.0, "named": named, "scan": 3})
    result = describe_variables(data, {"force": "Force."})
    names = {name: result[name].attrs.get("long_name") for name in result}
    assert names == {
        "force": "Force.", "force_interval": "Force.", "named": "Own.", "scan": None,
    }  # fmt: skip
    assert result.scan.units == "1" and "units" not in result.force.attrs
    assert data.force.attrs == {}


def test_the_meaning_in_one_dataset_overrides_that_in_all(tmp_path, monkeypatch):
    table = tmp_path / "variables.tsv"
    table.write_text("dataset\tvariable\tmeaning\n*\ta\tAll.\n*\tb\tAll.\none\ta\tOne.\n")
    monkeypatch.setattr("hardcontact.base.dataset.MEANINGS", table)
    assert read_meanings("one") == {"a": "One.", "b": "All."}
    assert read_meanings("another") == {"a": "All.", "b": "All."}


@pytest.mark.study
def test_every_variable_of_the_study_has_a_unit_and_a_meaning(results):
    # The numbers of claims stand in one variable, each in the unit of its claim.
    assert undescribed_variables(results) == [("sets", "value")]
    text = (results / "datasets.md").read_text("utf-8")
    assert {f"## {path.name}" for path in results.glob("*.nc")} <= {*text.splitlines()}
