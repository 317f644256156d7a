"""The command `hardcontact predict`: force, edges and regime from a spectrum, without a study."""

import json
import math
import re
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import pandas as pd

from hardcontact.commands.request import QUANTITIES, Option, add_quantities, add_reading, options
from hardcontact.config.configuration import read_yaml, refuse_all
from hardcontact.config.own_spectrum import own_spectrum
from hardcontact.config.schema import refuse_lines
from hardcontact.contact.bearing_area import Load
from hardcontact.insight.closed_form import (
    MANY_POINTS,
    SINGLE_PEAKS,
    SMOOTH,
    Contact,
    contact_area,
)
from hardcontact.insight.prediction import (
    ERROR,
    INSIDE,
    MATTERS,
    OUTSIDE,
    UNKNOWN,
    prediction,
    rough_part,
    too_wide,
)
from hardcontact.numbers.number import Number, plain
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.records.whole_file import whole_file

#: What the error was measured on, in the words of the help and of a prediction.
TRIED = f"within a factor of {ERROR:g} on random surfaces of 20 µm of four diamond coatings"
DESCRIPTION = f"""\
Predict the pull-off force of a smooth sphere from the power spectral density of a
surface, in closed form, within seconds:

  hardcontact predict my-psd.csv --radius 250um --range 5.6nm --work 46mJ/m2

The table has a header and these columns, with the unit of each in a column of its own:
  wavevector (q = 2 pi/wavelength, e.g. rad/nm) or wavelength (e.g. nm)
  c_iso (h_rms² = 1/(2 pi) ∫ q C_iso dq, e.g. nm4) or c_1d (h_rms² = (1/pi) ∫ C_1D dq, e.g. nm3)
for example, in five rows or more,

  wavelength,wavelength_unit,c_iso,c_iso_unit
  1000,nm,4.8e7,nm4

A c_iso of 0 says that there is no roughness of this wavelength. In place of a table FILE may
be a height map, a line scan or a container of them: their spectrum is measured, and only the
wavelengths at which it is reliable count. The closed form agrees with computed forces
{TRIED}.
"""
#: What a regime means.
MEANING = {
    SMOOTH: "the roughness hardly counts",
    MANY_POINTS: "the whole surface attracts, not only the points that touch",
    SINGLE_PEAKS: "the few highest summits carry the force",
}


def predict_arguments(arguments: Sequence[str]) -> Namespace:
    """Return a command line without `hardcontact predict`; a wrong one ends the program."""
    parser = ArgumentParser(
        "hardcontact predict", description=DESCRIPTION, formatter_class=RawDescriptionHelpFormatter
    )
    parser.add_argument("file", metavar="FILE", help="CSV of the power spectral density, or a scan")
    add_quantities(parser)
    add_reading(parser)
    parser.add_argument(
        "--dataset", "--channel", default="", metavar="NAME",
        help="the only scan of a container that counts, or the channel of another file",
    )  # fmt: skip
    for name in WRITERS:
        parser.add_argument(f"--{name}", metavar="FILE", help="write the numbers; - for stdout")
    return parser.parse_args(arguments)


def predict(arguments: Namespace) -> str:
    """Return the prediction, for the user, and write the files of numbers that were asked for.

    A file named - is returned in place of the words; all problems are a ValueError, a line each.
    """
    given, faults = options(arguments)
    load: Load = {"preload": given["preload"].number, "hardness": given["hardness"].number}
    radius, rho, work = (given[name].number for name in ("radius", "range", "work"))
    contact = Contact(radius, rho, work, contact_area(load))
    wide = too_wide(contact, given["preload"].number)
    if wide and not faults:
        faults.append(f"--{wide}")
    files = {name: file for name in WRITERS if (file := getattr(arguments, name)) is not None}
    if [*files.values()].count("-") > 1:
        faults.append("--csv: expected a file, as --json goes to stdout, found -")
    tip = given["tip"].number if "tip" in given else None
    reader = partial(
        own_spectrum,
        [arguments.file],
        dataset=arguments.dataset,
        tip_radius=tip,
        unit=arguments.unit,
    )
    _, (spectrum, notes) = refuse_all([partial(refuse_lines, faults), reader])
    tolerance = float(read_yaml("config/config.yaml")["scales"]["tolerance"])
    numbers = prediction(rough_part(spectrum, arguments.file), contact, tolerance)
    of_options = {
        name: Number(name, one.number, one.unit, status="given" if one.given else "paper")
        for name, one in given.items()
        if name in QUANTITIES
    }
    told = "\n".join([*notes, *_told(numbers, given)])
    for name, path in files.items():
        text = WRITERS[name](of_options | numbers)
        if path == "-":
            told = text
        else:
            with whole_file(path) as temporary:
                Path(temporary).write_text(text + "\n", "utf-8")
    return told


def _json(numbers: Mapping[str, Number]) -> str:
    """Return numbers by name, each with value and unit; interval and status where there are any."""
    entries = {
        name: {"value": plain(one.value), "unit": one.unit}
        | ({"interval": [one.low, one.high]} if math.isfinite(one.low + one.high) else {})
        | ({"status": one.status} if one.status else {})
        for name, one in numbers.items()
    }
    return json.dumps(entries, indent=2, allow_nan=False)


def _csv(numbers: Mapping[str, Number]) -> str:
    """Return numbers as a table, a row each; cells are empty where there is nothing."""
    columns = ["quantity", "value", "unit", "low", "high", "status"]
    table = pd.DataFrame([one[:6] for one in numbers.values()], columns=columns)
    known = table.replace([math.inf, -math.inf], math.nan)
    return str(known.to_csv(index=False, lineterminator="\n")).rstrip("\n")


#: Writers of files of numbers, by the option that names the file.
WRITERS: dict[str, Callable[[Mapping[str, Number]], str]] = {"json": _json, "csv": _csv}


def _told(numbers: Mapping[str, Number], given: Mapping[str, Option]) -> Iterator[str]:
    """Yield the lines of the prediction."""
    lengths = {name: print_length(one.value) for name, one in numbers.items() if one.unit == "nm"}
    force, freezing = numbers["pull_off_force"], numbers["freezing"]
    yield (
        f"spectrum: {lengths['shortest_wavelength']} to {lengths['longest_wavelength']}, "
        f"rms height {lengths['rms_height']}, rms gradient {numbers['rms_gradient'].value:.2g}"
    )
    for name, (_, meaning) in QUANTITIES.items():
        meaning = re.sub(" of the predicted force", "", meaning)
        source = "as given" if given[name].given else f"the paper's; --{name} changes it"
        yield f"{name}: {given[name].text} ({meaning}: {source})"
    yield (
        f"pull-off force: {print_quantity(float(f'{force.value:.2g}'), 'N')}, "
        f"{numbers['force_ratio'].value:.2g} of the "
        f"{print_quantity(numbers['smooth_force'].value, 'N')} of a smooth surface "
        f"({TRIED if force.status == INSIDE else 'less sure than a factor of two: see below'})"
    )
    yield f"closest approach: {lengths['closest_approach']} above the mean plane"
    regime = freezing.status.replace("_", " ")
    beside = f" (freezing {freezing.value:.3g}: beyond 1 single peaks decide)"
    yield f"regime: {regime}: {MEANING[regime]}{beside if regime != SMOOTH else ''}"
    for name, side in {"short": "below", "long": "above"}.items():
        edge = numbers[f"{name}_edge"].value
        yield (
            f"{name} edge: {print_length(edge) if math.isfinite(edge) else 'no wavelength'} "
            f"(without all roughness {side} it the force changes by "
            f"{100 * numbers['tolerance'].value:g} %)"
        )
    if numbers["short_edge"].value > numbers["long_edge"].value:
        yield "no band: all roughness on either side of any wavelength between both can be removed"
    yield from _cautions(numbers)


def _cautions(numbers: Mapping[str, Number]) -> Iterator[str]:
    """Yield what makes the prediction less sure."""
    for end, side in {"longest": "longer", "shortest": "shorter"}.items():
        change = numbers[f"{end}_octave_change"]
        beyond = f"waves {side} than {print_length(numbers[f'{end}_wavelength'].value)}"
        if change.status == MATTERS:
            yield (
                f"take care: {beyond} are not in the spectrum; its last octave alone changes the "
                f"force by {100 * change.value:.0f} %"
            )
        if change.status == UNKNOWN:
            yield f"take care: {beyond} are not in the spectrum, which is too short to tell more"
    gap = numbers["widest_gap"]
    if gap.status == UNKNOWN:
        yield (
            f"take care: neighbouring wavelengths of the spectrum are a factor of {gap.value:.2g} "
            "apart: between them it is interpolated"
        )
    tried = {name: numbers[f"tried_{name}"] for name in ("range", "radius", "area", "freezing")}
    rho, radius, area, freezing = tried.values()
    words = {
        "range": f"at ranges of {print_length(rho.low)} to {print_length(rho.high)}, not at "
        f"{print_length(rho.value)}",
        "radius": f"under a sphere of {print_length(radius.low)}, not of "
        f"{print_length(radius.value)}",
        "area": f"with {area.low:g} nm² in contact, not {area.value:.3g} nm²",
        "freezing": f"at a freezing of {freezing.high:g} at most, not at {freezing.value:.3g}",
    }
    for name, where in words.items():
        if tried[name].status == OUTSIDE:
            yield f"take care: the error was measured {where}"
