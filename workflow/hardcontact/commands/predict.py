"""The command `hardcontact predict`: force, edges and regime from a spectrum, without a study.

The user's own power spectral density is a table with its units, turned into C_iso; every fault of
it is one line: the file and its line, what was expected, what was found.
"""

import math
import re
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from hardcontact.commands.request import QUANTITIES, Option, options
from hardcontact.config.configuration import read_yaml, refuse_all
from hardcontact.config.schema import plain, refuse_lines
from hardcontact.config.tables import Row, UserTable, found, number, user_table
from hardcontact.contact.bearing_area import Load
from hardcontact.insight.closed_form import (
    MANY_POINTS,
    SINGLE_PEAKS,
    SMOOTH,
    ClosedForm,
    Contact,
    closed_form,
    contact_area,
    contact_share,
    edges,
    smooth_force,
)
from hardcontact.numbers.printing import print_length, print_quantity
from hardcontact.numbers.units import magnitude
from hardcontact.surfaces.measured_spectrum import isotropic_from_profile
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments

#: Factor within which the closed form gives forces computed on random surfaces of 20 µm with the
#: spectra of the four diamond coatings of the paper: 1.76 in closed_form.nc of the default study
#: (`insight.closed_form_errors`). On surfaces of 5 µm, which lack the long waves, it is 2.4.
ERROR = 1.8
#: What it was measured on, in the words of the help and of a prediction.
TRIED = f"within a factor of {ERROR:g} on random surfaces of 20 µm of four diamond coatings"
#: Ranges of adhesion and radius in nm and area in contact in nm² that it was measured at, and the
#: greatest freezing there: 83.5, rounded up.
RANGES, RADIUS, AREA, FREEZING = (0.5, 20.0), 250e3, 400.0, 84.0
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

A c_iso of 0 says that there is no roughness of this wavelength. The closed form agrees
with computed forces {TRIED}.
"""
#: What a regime means.
MEANING = {
    SMOOTH: "the roughness hardly counts",
    MANY_POINTS: "the whole surface attracts, not only the points that touch",
    SINGLE_PEAKS: "the few highest summits carry the force",
}
#: Rms height in nm below which there is no surface: a tenth of an atom.
LEAST_HEIGHT = 0.01
#: Columns of which a table has one of each pair, each with a column of its unit.
WAVES, DENSITIES = ("wavevector", "wavelength"), ("c_iso", "c_1d")
COLUMNS = "wavevector or wavelength, c_iso or c_1d, and the unit of each (wavevector_unit, ...)"
#: Powers of a length that a density has.
POWER = {"c_iso": 4, "c_1d": 3}
FEWEST = 5
#: Independent waves that each bin of a profile's density is taken to have when it is converted.
WAVES_OF_A_BIN = 20.0


def predict_arguments(arguments: Sequence[str]) -> Namespace:
    """Return a command line without `hardcontact predict`; a wrong one ends the program."""
    parser = ArgumentParser(
        "hardcontact predict",
        description=DESCRIPTION,
        formatter_class=RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", metavar="FILE", help="CSV of the power spectral density")
    paper = read_yaml("config/config.yaml")
    for name, (key, meaning) in QUANTITIES.items():
        group, quantity = key.split(".")
        usual = paper[group][quantity]
        parser.add_argument(f"--{name}", help=f"{meaning} (the paper's: {usual})")
    return parser.parse_args(arguments, Namespace(tip=None))


def predict(arguments: Namespace) -> str:
    """Return the prediction, for the user; all problems are a ValueError, a line each."""
    given, faults = options(arguments)
    faults = faults or [*_too_wide(given)]
    spectra: list[Spectrum] = []
    refuse_all(
        [partial(refuse_lines, faults), lambda: spectra.append(own_spectrum(arguments.file))]
    )
    (table,) = spectra
    rough = _between_zeros(table)
    _refuse_unreal_height(arguments.file, rough)
    tolerance = read_yaml("config/config.yaml")["scales"]["tolerance"]
    return "\n".join([*_left_out(table), *_told(rough, _contact(given), given, float(tolerance))])


def _contact(given: Mapping[str, Option]) -> Contact:
    """Return sphere, attraction and area in contact of the options."""
    load: Load = {"preload": given["preload"].number, "hardness": given["hardness"].number}
    radius, rho, work = (given[name].number for name in ("radius", "range", "work"))
    return Contact(radius, rho, work, contact_area(load))


def _too_wide(given: Mapping[str, Option]) -> Iterator[str]:
    """Yield that a contact alone would attract as much as the whole smooth sphere, if it would."""
    share, preload = contact_share(_contact(given)), given["preload"]
    if share >= 1:
        yield (
            f"--preload: expected less than {print_quantity(preload.number / share, 'N')} at this "
            f"hardness, radius and range, found {preload.text}: the contact alone would stick like "
            "a smooth sphere"
        )


def _between_zeros(spectrum: Spectrum) -> Spectrum:
    """Return a spectrum without the zeros at its ends: it ends where its roughness does."""
    first, *_, last = np.flatnonzero(spectrum.density > 0)
    rough = slice(first, last + 1)
    return Spectrum(spectrum.wavevector[rough], spectrum.density[rough])


def _left_out(spectrum: Spectrum) -> Iterator[str]:
    """Yield how many rows say that there is no roughness, if any do."""
    count = np.count_nonzero(spectrum.density == 0)
    if count:
        yield f"left out: {count} rows of the table with a density of 0, no roughness there"


def _refuse_unreal_height(path: str, spectrum: Spectrum) -> None:
    """Refuse a height below any atom's or above the longest wave: its unit is wrong."""
    height, longest = all_scales_moments(spectrum)[0], 2 * np.pi / spectrum.wavevector[0]
    if not LEAST_HEIGHT <= height <= longest:
        raise ValueError(
            f"{path}: expected densities of an rms height of {print_length(LEAST_HEIGHT)} to "
            f"{print_length(longest)}, its longest wavelength, found {height:.3g} nm: is the unit "
            "right?"
        )


def _told(
    spectrum: Spectrum, contact: Contact, given: Mapping[str, Option], tolerance: float
) -> Iterator[str]:
    """Yield the lines of the prediction."""
    height, gradient, _ = all_scales_moments(spectrum)
    longest, shortest = 2 * np.pi / spectrum.wavevector[[0, -1]]
    found = closed_form(spectrum, contact)
    smooth = smooth_force(contact)
    cautions = [*_cautions(spectrum, contact, found), *_untried(contact, found)]
    yield (
        f"spectrum: {print_length(shortest)} to {print_length(longest)}, "
        f"rms height {print_length(height)}, rms gradient {gradient:.2g}"
    )
    for name, (_, meaning) in QUANTITIES.items():
        meaning = re.sub(" of the predicted force", "", meaning)
        source = "as given" if given[name].given else f"the paper's; --{name} changes it"
        yield f"{name}: {given[name].text} ({meaning}: {source})"
    yield (
        f"pull-off force: {print_quantity(float(f'{found.force:.2g}'), 'N')}, "
        f"{found.force / smooth:.2g} of the {print_quantity(smooth, 'N')} of a smooth "
        "surface "
        f"({'less sure than a factor of two: see below' if cautions else TRIED})"
    )
    yield f"closest approach: {print_length(found.closest_approach)} above the mean plane"
    freezing = f" (freezing {found.freezing:.3g}: beyond 1 single peaks decide)"
    yield (
        f"regime: {found.regime}: {MEANING[found.regime]}"
        f"{freezing if found.regime != SMOOTH else ''}"
    )
    sides = {"short": "below", "long": "above"}
    found_edges = edges(spectrum, contact, tolerance)
    for edge, (name, side) in zip(found_edges, sides.items(), strict=True):
        shown = print_length(edge) if np.isfinite(edge) else "no wavelength"
        yield (
            f"{name} edge: {shown} (without all roughness {side} it the force changes by "
            f"{100 * tolerance:g} %)"
        )
    short, long = found_edges
    if short > long:
        yield "no band: all roughness on either side of any wavelength between both can be removed"
    yield from cautions


def _cautions(spectrum: Spectrum, contact: Contact, found: ClosedForm) -> Iterator[str]:
    """Yield what makes the prediction less sure: waves at the ends of the table that matter."""
    longest, shortest = 2 * np.pi / spectrum.wavevector[[0, -1]]
    ends = {
        f"longer than {print_length(longest)}": spectrum.wavevector >= 2 * spectrum.wavevector[0],
        f"shorter than {print_length(shortest)}": spectrum.wavevector
        <= spectrum.wavevector[-1] / 2,
    }
    for beyond, kept in ends.items():
        if kept.sum() < 2:
            continue
        inner = Spectrum(spectrum.wavevector[kept], spectrum.density[kept])
        change = abs(closed_form(inner, contact).force / found.force - 1)
        if change > 0.1:
            yield (
                f"take care: waves {beyond} are not in the table; its last octave alone changes "
                f"the force by {100 * change:.0f} %"
            )


def _untried(contact: Contact, found: ClosedForm) -> Iterator[str]:
    """Yield what lies outside of what the error was measured on."""
    least, most, radius = map(print_length, (*RANGES, RADIUS))
    rho, own_radius = print_length(contact.rho), print_length(contact.radius)
    tried = {
        f"at ranges of {least} to {most}, not at {rho}": RANGES[0] <= contact.rho <= RANGES[1],
        f"under a sphere of {radius}, not of {own_radius}": np.isclose(contact.radius, RADIUS),
        f"with {AREA:g} nm² in contact, not {contact.area:.3g} nm²": np.isclose(contact.area, AREA),
        f"at a freezing of {FREEZING:g} at most, not at {found.freezing:.3g}": (
            found.freezing <= FREEZING or found.regime == SMOOTH
        ),
    }
    for where, holds in tried.items():
        if not holds:
            yield f"take care: the error was measured {where}"


def own_spectrum(path: str | Path) -> Spectrum:
    """Read the user's own power spectral density from a CSV with a header.

    Columns: `wavevector` (q = 2 pi/lambda) or `wavelength`; `c_iso` (h_rms² = 1/(2 pi) ∫ q C_iso
    dq) or `c_1d` (h_rms² = (1/pi) ∫ C_1D dq); one of the unit of each, named for it with `_unit`,
    such as rad/nm, nm, nm4, nm3. A c_iso of 0 says no roughness. Returned is C_iso in nm⁴ at its
    own wavevectors, of profiles by the inverse Abel transform; problems are a ValueError, a line
    each.
    """
    table = user_table(path, "a table of a power spectral density")
    wave, density = _quantities(table)
    problems = table.problems(lambda row: _faults(row, wave, density))
    points = {
        line: (_wavevector(row, wave), _density(row, density))
        for line, row in table.rows().items()
        if not _faults(row, wave, density)
    }
    problems += _repeated(path, points)
    rough = sum(value > 0 for _, value in points.values())
    if not problems and rough < FEWEST:
        problems.append(f"{path}: expected at least {FEWEST} wavelengths, found {rough}")
    refuse_lines(problems)
    wavevector, values = np.array(sorted(points.values())).T
    if density == "c_1d":
        waves = np.full(values.shape, WAVES_OF_A_BIN)
        values = isotropic_from_profile(wavevector, values, waves)
    return Spectrum(wavevector, values)


def _quantities(table: UserTable) -> tuple[str, str]:
    """Return the names of the columns of waves and of densities."""
    path, header = table.path, table.header
    if not header:
        raise ValueError(f"{path}: expected the columns {COLUMNS}; found no column")
    faults, present = [], []
    for pair in (WAVES, DENSITIES):
        named = [name for name in pair if name in header]
        present += named[:1]
        if len(named) != 1:
            faults.append(
                f"{path}: expected one of the columns {' and '.join(pair)}, found "
                f"{'both' if named else plain(', '.join(header))}"
            )
    faults += [
        f"{path}: expected a column {name}_unit beside {name}, found none"
        for name in present
        if f"{name}_unit" not in header
    ]
    faults += [
        f"{path}: expected each column once, found {plain(name)} {header.count(name)} times"
        for name in dict.fromkeys(header)
        if header.count(name) > 1
    ]
    refuse_lines(faults)
    wave, density = present
    return wave, density


def _faults(row: Row, wave: str, density: str) -> list[str]:
    """Return what is wrong with the cells of a row."""
    faults = []
    if not _number(row[wave]) > 0:
        faults.append(f"{wave}: expected a positive number, found {found(row[wave])}")
    if not (_number(row[density]) > 0 or (density == "c_iso" and _number(row[density]) == 0)):
        least = "a number of at least 0" if density == "c_iso" else "a positive number"
        faults.append(f"{density}: expected {least}, found {found(row[density])}")
    expected = "a length, such as nm"
    if wave == "wavevector":
        expected = "radians over a length, such as rad/nm (q = 2 pi/wavelength)"
    if math.isnan(_wavevector({**row, wave: "1"}, wave)):
        unit = row[f"{wave}_unit"]
        faults.append(f"{wave}_unit: expected {expected}, found {found(unit)}")
    if math.isnan(_density({**row, density: "1"}, density)):
        unit, power = row[f"{density}_unit"], POWER[density]
        faults.append(
            f"{density}_unit: expected a length to the power of {power}, such as nm{power}, "
            f"found {found(unit)}"
        )
    return faults


def _repeated(path: str | Path, points: Mapping[int, tuple[float, float]]) -> list[str]:
    """Return the lines of wavelengths that were there before."""
    first: dict[str, int] = {}
    faults = []
    for line, (wavevector, _) in points.items():
        before = first.setdefault(f"{wavevector:.9g}", line)
        if before != line:
            faults.append(
                f"{path}: line {line}: expected each wavelength once, found that of line {before}"
            )
    return faults


def _number(text: str) -> float:
    """Return a finite number; NaN if the text is none."""
    value = number(text)
    return value if math.isfinite(value) else math.nan


def _wavevector(row: Row, name: str) -> float:
    """Return q in rad/nm; NaN if the unit is none of the quantity."""
    value, unit = _number(row[name]), row[f"{name}_unit"]
    if name == "wavelength":
        return 2 * math.pi / (value * _nanometres(unit))
    match = re.fullmatch(r"rad\s*/\s*(\S+)", unit)
    return value / _nanometres(match[1]) if match else math.nan


def _density(row: Row, name: str) -> float:
    """Return a density in powers of nm; NaN if the unit has another power."""
    digit = {3: "3³", 4: "4⁴"}[POWER[name]]
    match = re.fullmatch(rf"(\D+?)(?:\^|\*\*)?[{digit}]", row[f"{name}_unit"])
    length = _nanometres(match[1]) if match else math.nan
    return _number(row[name]) * length ** POWER[name]


def _nanometres(unit: str) -> float:
    """Return a unit of length in nm; NaN if it is none."""
    try:
        return magnitude(f"1 {unit}", "nm")
    except ValueError:
        return math.nan
