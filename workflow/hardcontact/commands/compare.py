"""The command `hardcontact compare`: the numbers of two studies side by side."""

import json
import os
from argparse import Namespace
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import xarray as xr

from hardcontact.base.dataset import read_dataset
from hardcontact.commands.options import CommandLine
from hardcontact.commands.outputs import align_cells, output_faults, results_folder, write_output
from hardcontact.config.faults import collect_faults, raise_faults
from hardcontact.report.study_comparison import (
    EQUAL_DIGITS,
    SET_DATASETS,
    add_paired_intervals,
    compare_answers,
    pairing,
)
from hardcontact.report.templates import Frame, render_document, render_lines

ANSWER = "answer.json"


def compare_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed arguments of the command; wrong ones end the program."""
    description = "Print the inputs and the numbers of two studies side by side."
    parser = CommandLine("hardcontact compare", description)
    for name in ("first", "second"):
        parser.add_argument(name, metavar=name.upper(), help=f"results of a study, or its {ANSWER}")
    parser.add_argument("--html", metavar="FILE", help="write a page, too; - for stdout")
    parser.add_argument("--overwrite", action="store_true", help="replace the page")
    return parser.parse_args(arguments)


def compare(arguments: Namespace) -> str:
    """Return the comparison as text, and write the page of --html; for "-" return it instead."""
    paths = [_answer_path(path) for path in (arguments.first, arguments.second)]
    inputs = {path: "those compared" for path in paths}
    faults = [*output_faults("html", arguments.html, inputs, arguments.overwrite)]
    answers = []
    for path in paths:
        with collect_faults(faults):
            answers.append(_read_answer(path))
    raise_faults(faults)
    names = [answer["study"] for answer in answers]
    if names[0] == names[1]:
        names = [arguments.first, arguments.second]
    first_sets, second_sets = (_read_sets(path) for path in paths)
    differing_inputs, numbers = compare_answers(*answers)
    pairing_of_sets = pairing(first_sets, second_sets)
    if pairing_of_sets == "paired":
        numbers = add_paired_intervals(numbers, first_sets, second_sets)
    facts = {
        "studies": names, "inputs": differing_inputs, "digits": EQUAL_DIGITS,
        "pairing": pairing_of_sets,
        "confidence": first_sets["sets"].attrs["confidence"] if first_sets else None,
        "numbers": sorted(numbers, key=lambda number: number.sort_key),
    }  # fmt: skip
    if arguments.html is not None:
        page = render_document("compare.html", Frame(version("hardcontact")), "comparison", **facts)
        if arguments.html == "-":
            return page
        write_output(arguments.html, page)
    # The template puts "|" between the cells of a row.
    rows = [line.split("|") for line in render_lines("compare.txt", **facts)]
    return "\n".join(align_cells(rows))


def _answer_path(path: str) -> str:
    """Return the path of the answer.json that a path, or the name of a study, means."""
    return path if os.path.isfile(path) else os.path.join(results_folder(path), ANSWER)


def _read_answer(path: str) -> dict[str, Any]:
    """Return the content of answer.json; raise ValueError if it is not the answer of a study."""
    if not Path(path).is_file():
        found = "no such folder"
        if Path(path).parent.is_dir():
            remedy = "`snakemake answer` makes it, with --configfile for any study but the paper's"
            found = f"none: {remedy}"
        raise ValueError(f"{path}: expected the answer of a finished study, found {found}")
    try:
        answer: Any = json.loads(Path(path).read_text("utf-8"))
    except ValueError:
        answer = None
    if not isinstance(answer, dict) or not {"kind", "quantities"} <= answer.keys():
        raise ValueError(f"{path}: expected the answer of a study, found another file")
    return answer


def _read_sets(path: str) -> dict[str, xr.Dataset]:
    """Return SET_DATASETS beside answer.json by name, or none if one is missing."""
    paths = {name: Path(path).parent / f"{name}.nc" for name in SET_DATASETS}
    if not all(dataset_path.is_file() for dataset_path in paths.values()):
        return {}
    return {name: read_dataset(dataset_path) for name, dataset_path in paths.items()}
