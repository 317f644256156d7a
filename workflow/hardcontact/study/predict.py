"""The command `hardcontact predict`: force, edges and regime from a spectrum, without a study."""

import re
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from hardcontact.answer.quantities import print_length, print_quantity
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
from hardcontact.study.configuration import read_yaml
from hardcontact.study.faults import refuse_all
from hardcontact.study.own_spectrum import own_spectrum
from hardcontact.study.request import QUANTITIES, Option, options
from hardcontact.surfaces.spectrum import Spectrum, all_scales_moments

__all__ = ["predict", "predict_arguments"]

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
    """Return the prediction, for the user.

    Parameters
    ----------
    arguments : argparse.Namespace
        As `predict_arguments` returns it.

    Returns
    -------
    str
        What was read and what it predicts.

    Raises
    ------
    ValueError
        In one line a problem, all of them.
    """
    given, faults = options(arguments)
    faults = faults or [*_too_wide(given)]
    spectra: list[Spectrum] = []
    refuse_all([partial(_refuse, faults), lambda: spectra.append(own_spectrum(arguments.file))])
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


def _refuse(faults: Sequence[str]) -> None:
    if faults:
        raise ValueError("\n".join(faults))


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
