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
from hardcontact.config.faults import refuse_all, refuse_lines
from hardcontact.config.model import Study
from hardcontact.config.own_spectrum import own_spectrum
from hardcontact.contact.smooth_sphere import Material, effective_modulus
from hardcontact.insight.closed_form import (
    MANY_POINTS,
    SINGLE_PEAKS,
    SMOOTH,
    Contact,
    contact_area,
)
from hardcontact.insight.prediction import (
    CHANGE,
    HARD,
    MATTERS,
    OUTSIDE,
    UNKNOWN,
    prediction,
    tabor,
    too_wide,
)
from hardcontact.numbers.number import Number, plain
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.records.whole_file import whole_file

#: Where nine of ten surfaces like the user's lie, in the words of the help and of a prediction.
LIKELY = "of ten surfaces like this nine lie between"
DESCRIPTION = """\
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
wavelengths at which it is reliable count, and then also those that continue them.
"""
#: What an error depends on.
TRIED_WORDS = {
    "rho": "ranges",
    "radius": "radii",
    "modulus": "moduli k = range x closest approach / rms height²",
    "contact_over_rolloff": "roots of the contact area over the roll-off",
}
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
    parser.add_argument("--modulus", help="effective modulus of both bodies (that of the paper's)")
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
    radius, rho, work = (given[name].number for name in ("radius", "range", "work"))
    contact = Contact(
        radius, rho, work, contact_area(given["preload"].number, given["hardness"].number)
    )
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
    _, (spectrum, notes, joined) = refuse_all([partial(refuse_lines, faults), reader])
    tolerance = Study().scales.tolerance
    numbers = prediction(spectrum, contact, tolerance, arguments.file, joined)
    modulus = given["modulus"].number if "modulus" in given else _modulus()
    stated = Number("modulus", modulus, "Pa", status="given" if "modulus" in given else "paper")
    numbers |= {"modulus": stated, "tabor_parameter": tabor(contact, modulus)}
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


def _modulus() -> float:
    """Return the effective modulus (Pa) of the paper's bodies."""
    elastic = Study().elastic
    bodies: list[Material] = [
        {"modulus": body.modulus, "poisson_ratio": body.poisson_ratio}
        for body in (elastic.sphere, elastic.substrate)
    ]
    return effective_modulus(*bodies)


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
        f"pull-off force: {_printed(force)}, {numbers['force_ratio'].value:.2g} of the "
        f"{print_quantity(numbers['smooth_force'].value, 'N')} of a smooth surface"
    )
    yield (
        f"scatter: ln F of single contacts has a standard deviation of "
        f"{numbers['force_scatter'].value:.2g} over places"
    )
    if "continued_force" in numbers:
        hurst, longest = numbers["continued_hurst"].value, lengths["longest_wavelength"]
        above = f"rises above {longest} to a roll-off at {lengths['continued_rolloff']}"
        below = f" and goes on below {lengths['shortest_wavelength']} to {lengths['continued_to']}"
        yield (
            "pull-off force if the spectrum "
            + (above if _rises(numbers) else f"is level above {longest}")
            + f"{below}, with a Hurst exponent of {hurst:.2g}" * math.isfinite(hurst)
            + f": {_printed(numbers['continued_force'])}"
        )
        short, long = (
            lengths[f"continued_{name}"]
            if math.isfinite(numbers[f"continued_{name}"].value)
            else "no wavelength"
            for name in ("short_edge", "long_edge")
        )
        yield f"edges if it does so: {short} and {long}"
    yield f"closest approach: {lengths['closest_approach']} above the mean plane"
    regime = freezing.status.replace("_", " ")
    beside = f" (freezing {freezing.value:.3g}: beyond 1 single peaks decide)"
    yield f"regime: {regime}: {MEANING[regime]}{beside if regime != SMOOTH else ''}"
    for name, side in {"short": "below", "long": "above"}.items():
        edge = numbers[f"{name}_edge"]
        yield (
            f"{name} edge: {_printed(edge) if math.isfinite(edge.value) else 'no wavelength'}; "
            f"without all roughness {side} it the force changes by "
            f"{100 * numbers['tolerance'].value:g} %"
        )
    if numbers["short_edge"].value > numbers["long_edge"].value:
        yield "no band: all roughness on either side of any wavelength between both can be removed"
    tabor_number, modulus = numbers["tabor_parameter"], numbers["modulus"]
    yield (
        f"Tabor parameter: {tabor_number.value:.2g} at the range of adhesion and "
        f"{modulus.value / 1e9:.3g} GPa "
        f"({'as given' if modulus.status == 'given' else 'of the paper; --modulus changes it'})"
    )
    yield from _cautions(numbers)


def _rises(numbers: Mapping[str, Number]) -> bool:
    """Return whether the continued spectrum rises above the longest wavelength there is."""
    rolloff = numbers.get("continued_rolloff")
    return rolloff is not None and rolloff.value > 1.001 * numbers["longest_wavelength"].value


def _printed(one: Number) -> str:
    """Return a force or a length to two digits, with its interval or that it has none."""
    value, low, high = (
        print_length(end) if one.unit == "nm" else print_quantity(float(f"{end:.2g}"), one.unit)
        for end in (one.value, one.low, one.high)
    )
    if math.isfinite(one.low):
        return f"{value} ({LIKELY} {low} and {high})"
    return f"{value} (error not known: see below)"


def _cautions(numbers: Mapping[str, Number]) -> Iterator[str]:
    """Yield what makes the prediction less sure."""
    if numbers["tabor_parameter"].status != HARD:
        yield (
            "take care: elasticity lowers the force on a smooth sphere of these bodies by more "
            f"than {100 * CHANGE:g} %: they are no hard contact"
        )
    ends = {"longest_octave": ("longer", "longest"), "continued": ("shorter", "shortest")}
    for name, (side, end) in ends.items():
        change = numbers[f"{name}_change"]
        beyond = f"waves {side} than {print_length(numbers[f'{end}_wavelength'].value)}"
        if name == "continued" and _rises(numbers):
            beyond += f" and longer than {print_length(numbers['longest_wavelength'].value)}"
        if change.status == MATTERS:
            by = (
                "its last octave alone changes"
                if side == "longer"
                else "their continuation changes"
            )
            yield (
                f"take care: {beyond} are not in the spectrum; {by} the force by "
                f"{100 * change.value:.0f} %"
            )
        if change.status == UNKNOWN:
            yield f"take care: {beyond} are not in the spectrum, which cannot tell how they matter"
    gap = numbers["widest_gap"]
    if gap.status == UNKNOWN:
        yield (
            f"take care: neighbouring wavelengths of the spectrum are a factor of {gap.value:.2g} "
            "apart: between them it is interpolated"
        )
    for name, words in TRIED_WORDS.items():
        one = numbers[f"tried_{name}"]
        if one.status == OUTSIDE:
            value, low, high = (
                print_length(end) if one.unit == "nm" else f"{end:.2g}"
                for end in (one.value, one.low, one.high)
            )
            yield f"take care: the error was measured at {words} of {low} to {high}, not at {value}"
