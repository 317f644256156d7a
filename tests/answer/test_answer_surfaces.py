"""The script that answers: datasets on disk become a page, its numbers and their record."""

import json
import os
import runpy
from types import SimpleNamespace

import pytest
from answer_inputs import datasets, fit, setting
from html_page import Page
from repository import ROOT
from snakemake.iocontainers import Namedlist

from hardcontact.records import dataset
from hardcontact.records.origin import canonical


def named(paths):
    """Return inputs as Snakemake gives them to a script: no file stands for no own forces."""
    inputs = Namedlist(str(path) for path in paths.values())
    for place, name in enumerate(paths):
        inputs._set_name(name, place)
    inputs.append(str(ROOT / "resources/adhesion/pairs.csv"))
    inputs._set_name("pairs", len(paths))
    if "fit" not in paths:
        inputs._set_name("fit", len(inputs), end=len(inputs))
    return inputs


def run(folder, given):
    """Run the script as the workflow does, on files in a folder."""
    inputs = {name: folder / f"{name}.nc" for name, one in given._asdict().items() if one}
    for name, path in inputs.items():
        dataset.write(getattr(given, name), path)
    outputs = {"page": folder / "answer.html", "json": folder / "answer.json"}
    given_setting = setting([("part", "why")])._asdict()
    del given_setting["pairs"]
    job = SimpleNamespace(
        input=named(inputs),
        output=Namedlist(fromdict={name: str(path) for name, path in outputs.items()}),
        params=SimpleNamespace(canonical=canonical(given_setting)),
        log=[str(folder / "answer.log")],
        threads=1,
    )
    runpy.run_path(str(ROOT / "workflow/scripts/answer_surfaces.py"), {"snakemake": job})
    return {name: path.read_text("utf-8") for name, path in outputs.items()}


@pytest.mark.parametrize("of_forces", [None, fit()])
def test_files_become_a_page_and_the_same_numbers(tmp_path, monkeypatch, of_forces):
    # A script that fails ends its process, which here is that of the tests.
    monkeypatch.setattr(os, "_exit", pytest.fail)
    made = run(tmp_path, datasets(fit=of_forces))
    numbers = json.loads(made["json"])
    sections = [one["id"] for one in Page(made["page"]).attributes["section"]]
    assert ("forces" in sections) == (of_forces is not None)
    assert (numbers["fit"] is None) == (of_forces is None)
    names = [row["name"] for row in numbers["surfaces"]["my_coating"]["answer"]]
    assert names.count("force_of_pair") == 2  # the pair asked for is that of the paper
    assert numbers["left_out"] == [{"part": "part", "reason": "why"}]
