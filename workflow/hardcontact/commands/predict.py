"""The command `hardcontact predict`: the force on a map, and predictions from its spectrum."""

import json
import math
import sys
from argparse import Namespace
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import Any, NamedTuple

from hardcontact.base.formatting import format_length, format_quantity
from hardcontact.base.number import Number, json_value
from hardcontact.commands.options import (
    CommandLine,
    QuantityOption,
    add_shared_options,
    contact_of_quantities,
    parse_quantities,
    reading_options,
    unit_questions,
)
from hardcontact.commands.outputs import output_faults, write_output
from hardcontact.commands.scan_cautions import single_pixel_cautions
from hardcontact.config.configuration import CONTACT_QUANTITIES
from hardcontact.config.faults import collect_faults, raise_faults
from hardcontact.config.keys import Study
from hardcontact.contact.contact import Contact
from hardcontact.contact.hertz_jkr_dmt import assumed_modulus, judge_tabor_parameter
from hardcontact.own.own_spectrum import OwnSpectrum, add_sphere_roughness, read_own_spectrum
from hardcontact.own.scan_force import prediction_and_scan_force
from hardcontact.own.wide_pixels import WIDE_PIXEL_WIDTH
from hardcontact.scans.heights import TAKE_CARE
from hardcontact.theory.closed_form import wide_contact_message
from hardcontact.theory.prediction import MAX_NEGLIGIBLE_CHANGE

#: The paper's study. Its settings serve where the command has no option.
PAPER_STUDY = Study()
CONTACTS_PER_ROW = PAPER_STUDY.contact.contacts_per_row
USAGE = Path(__file__).with_name("predict_help.txt").read_text("utf-8")


def predict_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed arguments of the command; wrong ones end the program."""
    parser = CommandLine("hardcontact predict", USAGE)
    parser.add_argument("file", metavar="FILE", help="CSV of the power spectral density, or a scan")
    add_shared_options(parser)
    parser.add_argument(
        "--sphere", metavar="FILE", help="scan of the sphere where it touches (default: smooth)"
    )
    parser.add_argument("--modulus", help="effective modulus of both bodies (default: the paper's)")
    parser.add_argument(
        "--dataset", "--channel", default="", metavar="NAME",
        help="the only scan of a container to read, or the channel of another file",
    )  # fmt: skip
    parser.add_argument("--verbose", action="store_true", help="print all numbers and cautions")
    parser.add_argument("--json", metavar="FILE", help="write the numbers; - for stdout")
    parser.add_argument("--overwrite", action="store_true", help="replace the file of numbers")
    return parser.parse_args(arguments)


class Inputs(NamedTuple):
    """The inputs of a prediction, read from the command line and its files."""

    quantities: dict[str, QuantityOption]  #: By name.
    contact: Contact
    spectrum: OwnSpectrum  #: Spectrum of both bodies if the sphere is rough.
    notes: list[str]  #: Those that begin with TAKE_CARE are cautions.


def predict(arguments: Namespace) -> str:
    """Return the prediction in words, and write the JSON of --json; for "-" return it instead."""
    inputs = read_inputs(arguments)
    numbers = compute_numbers(inputs, arguments.file)
    if arguments.json == "-":
        sys.stderr.writelines(f"{line}\n" for line in inputs.notes)
        return numbers_as_json(numbers)
    if arguments.json is not None:
        write_output(arguments.json, numbers_as_json(numbers) + "\n")
    return _report(inputs, numbers, arguments)


def read_inputs(arguments: Namespace) -> Inputs:
    """Return the inputs of a prediction."""
    quantities, faults = parse_quantities(arguments)
    contact = contact_of_quantities(quantities, CONTACTS_PER_ROW)
    cautions = [*unit_questions(quantities)]
    wide_message = wide_contact_message(contact)  # It begins with the name of an option.
    if wide_message and not faults:
        faults.append("; ".join([f"--{wide_message}", *cautions]))
    faults += output_faults(
        "json", arguments.json, {arguments.file: "that of the surface"}, arguments.overwrite
    )
    options = reading_options(arguments, quantities)
    with collect_faults(faults):
        spectrum = read_own_spectrum([arguments.file], options, dataset=arguments.dataset)
    if arguments.sphere is not None:
        with collect_faults(faults):
            sphere_spectrum = read_own_spectrum(
                [arguments.sphere], options, sphere_radius=contact.radius
            )
    raise_faults(faults)
    if arguments.sphere is not None:
        spectrum = add_sphere_roughness(spectrum, sphere_spectrum, PAPER_STUDY.seed)
    maps = [scan for scan in spectrum.scans if scan.kind == "map"]  # Line scans touch nothing.
    cautions += single_pixel_cautions(contact.area, [scan.pixel_size for scan in maps])
    notes = [*(f"{TAKE_CARE}{line}" for line in cautions), *spectrum.notes]
    return Inputs(quantities, contact, spectrum, notes)


class QuantityStatus(StrEnum):
    """Whether the user gave a quantity, or it is the paper's."""

    GIVEN, FROM_PAPER = "given", "paper"


def compute_numbers(inputs: Inputs, file: str) -> dict[str, Number]:
    """Return the numbers of a prediction by name, with the quantities of the contact."""
    quantities, contact, spectrum, _ = inputs
    numbers = {name: _quantity_number(name, quantities[name]) for name in CONTACT_QUANTITIES}
    tolerance, confidence = PAPER_STUDY.band.tolerance, PAPER_STUDY.intervals.confidence
    numbers |= prediction_and_scan_force(spectrum, contact, tolerance, confidence, file)
    modulus = QuantityOption("", assumed_modulus(contact.hardness), "Pa", is_given=False)
    numbers["modulus"] = _quantity_number("modulus", quantities.get("modulus", modulus))
    numbers["tabor_parameter"] = judge_tabor_parameter(contact, numbers["modulus"].value)
    return numbers


def _quantity_number(name: str, option: QuantityOption) -> Number:
    """Return a quantity of the user or of the paper as a number."""
    status = QuantityStatus.GIVEN if option.is_given else QuantityStatus.FROM_PAPER
    return Number(name, option.number, option.unit, status=status)


def numbers_as_json(numbers: Mapping[str, Number]) -> str:
    """Return numbers as JSON by name, with the intervals and statuses that are known."""
    entries: dict[str, dict[str, Any]] = {}
    for name, number in numbers.items():
        entries[name] = {"value": json_value(number.value), "unit": number.unit}
        if math.isfinite(number.low + number.high):
            entries[name]["interval"] = [number.low, number.high]
        if number.status:
            entries[name]["status"] = number.status
    return json.dumps(entries, indent=2, allow_nan=False)


def _report(inputs: Inputs, numbers: Mapping[str, Number], arguments: Namespace) -> str:
    """Return the prediction in words, with quantities as the user or the paper wrote them."""
    # Imported late, because jinja2 takes as long as a prediction.
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent), undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {"length": format_length, "quantity": format_quantity}
    environment.tests["known"] = math.isfinite
    report = environment.get_template("predict.txt").render(
        file=arguments.file,
        verbose=arguments.verbose,
        numbers=numbers,
        texts={name: inputs.quantities[name].text for name in CONTACT_QUANTITIES},
        scans=inputs.spectrum.scans,
        reading_notes=[note for note in inputs.notes if not note.startswith(TAKE_CARE)],
        cautions=[note for note in inputs.notes if note.startswith(TAKE_CARE)],
        meanings={name: meaning for name, (_, meaning) in CONTACT_QUANTITIES.items()},
        change_that_matters=MAX_NEGLIGIBLE_CHANGE,
        confidence=PAPER_STUDY.intervals.confidence,
        wide_pixel_width=WIDE_PIXEL_WIDTH,
    )
    return report.rstrip()
