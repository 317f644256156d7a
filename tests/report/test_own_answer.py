"""answer.json of own surfaces: one flat list with the numbers of the datasets."""

import json
import os
import runpy
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from answer_inputs import (
    RANGE,
    WORK,
    datasets,
    edges,
    fit,
    force,
    open_edges,
    setting,
    spectra,
    topography,
    unresolved_edges,
)  # fmt: skip
from html_page import Page
from jsonschema import Draft202012Validator
from own_numbers import numbers_of
from repository import ROOT
from snakemake.iocontainers import Namedlist

from hardcontact.base import dataset
from hardcontact.base.origin import canonical
from hardcontact.report.figures.listing import FILE_KINDS, OWN_FIGURES
from hardcontact.report.own_answer import own_answer
from hardcontact.report.quantities import answer_text

SCHEMA = json.loads((ROOT / "workflow/schemas/answer.schema.json").read_text("utf-8"))


def contradicting():
    data = spectra()
    data["psd"][0, 2] *= 100
    return data


CASES = {
    "one": datasets(),
    "open, one force": datasets(edges=open_edges(), fit=fit()),
    "two substitutes, forces": datasets(2, topography=topography(2, "substitute"), fit=fit(2)),
    "no band": datasets(edges=unresolved_edges()),
    "contradiction": datasets(spectra=contradicting()),
}


@cache
def content(case):
    return json.loads(answer_text(own_answer(CASES[case], setting())))


def quantities(case, surface="my_coating"):
    """The quantities of a surface by name."""
    rows = content(case)["quantities"]
    return {row["name"]: row for row in rows if row["surface"] == surface}


@pytest.mark.parametrize("case", CASES)
def test_the_answer_follows_its_schema(case):
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(content(case))


def test_the_answer_has_the_numbers_of_the_datasets():
    study_rows, surface_rows = quantities("one", ""), quantities("one")
    assert (study_rows["range_of_adhesion"]["value"], study_rows["work_of_adhesion"]["value"]) == (
        RANGE, WORK,
    )  # fmt: skip
    assert study_rows["range_of_adhesion"]["source"] == "given"
    assert study_rows["work_of_adhesion"]["source"] == "assumed"
    long = edges().sel(surface="my_coating", side="large")
    assert surface_rows["long_edge"]["value"] == long["edge"]
    ends = [surface_rows["long_edge"][end] for end in ("low", "high")]
    assert ends == long["edge_interval"].values.tolist()
    plastic = force().sel(surface="my_coating", contact_model="plastic", rho=RANGE)
    assert surface_rows["force_mean"]["value"] == plastic["force"]
    assert surface_rows["force_middle"]["high"] == plastic["force_quantile"][-1]
    assert surface_rows["force_of_pair_long_range_range"]["value"] == 10.0
    heights = topography().sel(surface="my_coating")["rms_height"].values
    assert surface_rows["scan_2_rms_height"]["value"] == heights[1]
    assert surface_rows["all_scales_rms_height"]["value"] == 6.2
    assert surface_rows["measurement_1_shortest_reliable"]["value"] == 55.0


def test_the_answer_has_the_three_octaves_that_matter_most_and_that_a_scan_shows():
    rows = quantities("one")
    assert [rows[f"octave_{rank}"]["value"] for rank in (1, 2, 3)] == [80, 160, 40]
    numbers = [rows[f"octave_{rank}_sensitivity"] for rank in (1, 2, 3)]
    assert [number["value"] for number in numbers] == [-0.9, -0.4, -0.2]
    assert (numbers[0]["low"], numbers[0]["high"]) == (-1.4, -0.4)
    assert "octave_4" not in rows


def test_cautions_are_codes_with_their_numbers():
    cautions = [note for note in content("contradiction")["notes"] if note["kind"] == "caution"]
    assert {"contradiction", "tail"} <= {note["code"] for note in cautions}
    factor = quantities("contradiction")["contradiction_factor"]["value"]
    assert factor == pytest.approx(100, rel=0.2)


def test_the_head_says_whether_each_surface_is_answered():
    (surface,) = content("no band")["surfaces"]
    assert (surface["name"], surface["answered"]) == ("my_coating", "no")
    names = [surface["name"] for surface in content("two substitutes, forces")["surfaces"]]
    assert names == ["my_coating", "twin"]


def test_substitutes_are_a_grave_note():
    (note,) = [n for n in content("two substitutes, forces")["notes"] if n["grave"]]
    assert note["code"] == "substitutes" and "my coating (substitute), twin" in note["text"]


@pytest.mark.parametrize(("paper_values", "count"), [(["work of adhesion"], 2), (["hardness"], 0)])
def test_forces_at_other_pairs_are_shown_only_if_range_or_work_are_the_paper_s(paper_values, count):
    numbers = numbers_of(setting()._replace(of_paper=paper_values))
    pairs = {"force_of_pair_long_range", "force_of_pair_short_range"}
    assert len(pairs & numbers.keys()) == count


def run_script(folder, own_datasets):
    """Run the script as the workflow does, on files in a folder; return its texts."""
    inputs = {name: folder / f"{name}.nc" for name, data in own_datasets._asdict().items() if data}
    for name, path in inputs.items():
        dataset.write(getattr(own_datasets, name), path)
    inputs["pairs"] = ROOT / "resources/adhesion/pairs.csv"
    inputs["citation"] = ROOT / "CITATION.cff"
    script_inputs = Namedlist(fromdict={name: str(path) for name, path in inputs.items()})
    outputs = {"page": folder / "answer.html", "json": folder / "answer.json"}
    output = Namedlist(fromdict={name: str(path) for name, path in outputs.items()})
    for kind in FILE_KINDS:
        start = len(output)
        output.extend(str(folder / f"{name}.{kind}") for name in OWN_FIGURES)
        output._set_name(kind, start, end=len(output))
    parameters = setting()._asdict()
    del parameters["pairs"]
    job = SimpleNamespace(
        input=script_inputs,
        output=output,
        params=SimpleNamespace(canonical=canonical(parameters)),
        log=[str(folder / "answer.log")],
        threads=1,
    )
    runpy.run_path(str(ROOT / "workflow/scripts/answer_surfaces.py"), {"snakemake": job})
    return {name: path.read_text("utf-8") for name, path in outputs.items()}


def test_files_become_a_page_and_the_same_numbers(tmp_path, monkeypatch):
    # A failing script ends its process, here the process of the tests.
    monkeypatch.setattr(os, "_exit", pytest.fail)
    texts = run_script(tmp_path, datasets(fit=fit()))
    rows = {row["name"]: row for row in json.loads(texts["json"])["quantities"]}
    assert rows["measured_force"]["value"] == 0.64e-6
    assert "forces" in [section["id"] for section in Page(texts["page"]).attributes["section"]]
    assert np.isfinite(rows["smooth_sphere"]["value"])
