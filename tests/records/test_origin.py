"""What determined a file: equal texts for equal origins."""

import hashlib
import json
from importlib.metadata import version

from refusals import assert_says, refusal
from repository import ROOT

from hardcontact.records.origin import Origin, canonical, digest, digests, pinned_versions


def test_parameters_have_one_text():
    assert canonical({"b": [1, 2.5], "a": "µ"}) == '{"a":"µ","b":[1,2.5]}'
    assert canonical({"a": 1, "b": 2}) == canonical({"b": 2, "a": 1})
    assert canonical({"a": 1}) != canonical({"a": 1.0})


def test_digests_are_of_contents_and_order(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    first.write_bytes(b"1")
    second.write_bytes(b"2")
    one = hashlib.sha256(b"1").digest()
    assert digest([first]) == hashlib.sha256(one).hexdigest()
    assert digest([first, second]) != digest([second, first])
    assert json.loads(digests([first, second, first])) == {
        str(path): digest([path]) for path in (first, second)
    }


def test_attributes_tell_parameters_inputs_and_code_apart(tmp_path):
    data, script = tmp_path / "data.nc", tmp_path / "script.py"
    data.write_text("data")
    script.write_text("code")
    origin = Origin("{}", [str(data), str(script)], [str(script)])
    before = origin.attributes()
    assert before == origin.attributes()
    assert json.loads(before["versions"])["numpy"] == version("numpy")
    data.write_text("other data")
    after = origin.attributes()
    assert {key for key in before if before[key] != after[key]} == {"input_digests"}
    script.write_text("other code")
    last = origin.attributes()
    assert {key for key in after if after[key] != last[key]} == {"input_digests", "code_digest"}


def test_pins_are_read_and_other_requirements_are_not(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text(
        "# numpy==0 is a comment\n-c workflow/constraints.txt\n-e .\n"
        "numpy==2.0\nxarray>=1\n--no-index\npytest[extra]==1\n"
    )
    assert pinned_versions(path) == {"numpy": version("numpy"), "pytest": version("pytest")}


def test_a_package_that_is_not_installed_is_named(tmp_path):
    path = tmp_path / "environment.txt"
    path.write_text("no-such-package==1\n")
    assert_says(refusal(pinned_versions, path), "environment.txt: expected", "no-such-package")


def test_every_pin_of_the_environment_is_read():
    lines = (ROOT / "environment.txt").read_text().splitlines()
    versions = pinned_versions(ROOT / "environment.txt")
    assert {"numpy", "snakemake"} <= versions.keys()
    assert len(versions) == sum("==" in line and not line.startswith("#") for line in lines)
