"""The closed form beside forces computed on random surfaces of the same spectrum."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from hardcontact.adhesion.pull_off import pull_off_of_pair
from hardcontact.contact.contact import Contact as ArrayContact
from hardcontact.contact.geometry import bodies
from hardcontact.insight.closed_form import (
    Contact,
    closed_form,
    edges,
    filtered_spectrum,
)
from hardcontact.insight.summits import banded
from hardcontact.numbers.random import generator
from hardcontact.numbers.statistics import student_log_interval
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.synthesis import SIDES, random_surface

#: Where closest approach comes from.
SOURCES = ["spectrum", "contacts"]


@dataclass(frozen=True)
class Trial:
    """Surfaces that the closed form is tried on, and what touches them."""

    pixels: int  #: Of each periodic surface along an edge.
    realizations: int  #: Surfaces of each size.
    sizes: tuple[float, ...]  #: Edges of the surfaces in nm.
    ranges: tuple[float, ...]  #: Of adhesion in nm.
    #: Wavelengths (nm) below which ("small") and above which ("large") roughness is removed.
    cutoffs: Mapping[str, Sequence[float]]
    contact: ArrayContact  #: On each.
    work: float  #: W in J/m².
    rho: float  #: The range (nm) of the edges.
    tolerance: float  #: Change of the force that counts for an edge.
    confidence: float  #: Of intervals.
    seed: int  #: Of the surfaces.


def spectrum_of_grid(spectrum: Spectrum, size: float, pixels: int) -> Spectrum:
    """Return the waves that a periodic surface of a size (nm) holds.

    Both ends are circles of the area of the square of wavevectors that they stand for: the cell at
    zero, which is left out, and all up to Nyquist.
    """
    cell = 2 * np.pi / size
    waves = banded(spectrum, cell / np.sqrt(np.pi), pixels * cell / np.sqrt(np.pi))
    if waves is None:
        raise ValueError(f"expected waves between {size / pixels:g} and {size:g} nm, found none")
    return waves


def closed_form_errors(spectra: Mapping[str, Spectrum], trial: Trial) -> xr.Dataset:
    """Return computed and predicted forces, and what the closed form says of all scales.

    Over (surface, map_size, rho): ``computed_force`` in N, mean plastic force over contacts and
    realizations with its interval over realizations; also over source ("spectrum": closest approach
    expected, "contacts": that computed) ``predicted_force``, ``first_term_force`` (N),
    ``freezing``, and ``error``, predicted over computed. Over (surface, map_size)
    ``computed_approach`` and ``predicted_approach`` in nm. Of the whole spectra ``whole_force``
    (N), ``whole_freezing`` and ``regime`` over (surface, rho), ``edge`` (surface, side) in nm, and
    ``filtered_ratio`` (surface, side, cutoff_wavelength), the force without the waves of a side
    over that with all; NaN at cutoffs of the other side.
    """
    compared = [
        [_compared(name, one, size, trial) for size in trial.sizes] for name, one in spectra.items()
    ]
    grids = xr.combine_nested(compared, ["surface", "map_size"], combine_attrs="drop")
    interval = student_log_interval(grids.force, trial.confidence, "realization")
    computed = grids.force.mean("realization")
    result = grids.drop_vars("force").assign(
        computed_force=computed.assign_attrs(units="N"),
        computed_force_interval=interval.assign_attrs(units="N"),
        error=(grids.predicted_force / computed).assign_attrs(units="1"),
    )
    whole = [_whole(one, trial) for one in spectra.values()]
    return (
        result.merge(xr.concat(whole, "surface", combine_attrs="drop"))
        .assign_coords(
            surface=list(spectra),
            map_size=("map_size", list(trial.sizes), {"units": "nm"}),
            rho=("rho", list(trial.ranges), {"units": "nm", "long_name": "range of adhesion"}),
            source=SOURCES,
            side=list(SIDES),
        )
        .assign_attrs(
            sphere_radius=trial.contact.radius,
            work_of_adhesion=trial.work,
            range_of_adhesion=trial.rho,
            scale_tolerance=trial.tolerance,
            confidence=trial.confidence,
        )
    )


def _compared(name: str, spectrum: Spectrum, size: float, trial: Trial) -> xr.Dataset:
    """Return computed and predicted forces of one surface and size of map."""
    pixel_size = size / trial.pixels
    forces, approaches = [], []
    for realization in range(trial.realizations):
        rng = generator(trial.seed, name, f"{size:g}", realization, "closed form")
        surface = random_surface(rng, trial.pixels, pixel_size, spectrum)
        pair = bodies(surface, None, trial.contact)
        plastic = pull_off_of_pair(pair, trial.contact, trial.ranges).sel(contact_model="plastic")
        forces.append(plastic["pull_off_force"].values.mean(axis=(1, 2)) * trial.work)
        approaches.append(-plastic["closest_approach"].values)
    waves = spectrum_of_grid(spectrum, size, trial.pixels)
    area = trial.contact.pixels(pixel_size) * pixel_size**2
    contacts = [Contact(trial.contact.radius, rho, trial.work, area) for rho in trial.ranges]
    given = {"spectrum": None, "contacts": np.array(approaches)}
    formulas = [[closed_form(waves, one, given[source]) for one in contacts] for source in SOURCES]
    first, over, newton = formulas[0][0], ("source", "rho"), {"units": "N"}
    smooth = first.force / first.relative
    predicted = [[one.force for one in row] for row in formulas]
    of_first_term = [[one.first_term * smooth for one in row] for row in formulas]
    freezing = [[one.freezing for one in row] for row in formulas]
    return xr.Dataset(
        {
            "force": (("realization", "rho"), np.array(forces), newton),
            "predicted_force": (over, predicted, newton),
            "first_term_force": (over, of_first_term, newton),
            "freezing": (over, freezing, {"units": "1"}),
            "computed_approach": ((), np.mean(approaches), {"units": "nm"}),
            "predicted_approach": ((), first.closest_approach, {"units": "nm"}),
        }
    )


def _whole(spectrum: Spectrum, trial: Trial) -> xr.Dataset:
    """Return what the closed form says of a spectrum of all scales."""
    contact = Contact(trial.contact.radius, trial.rho, trial.work, trial.contact.area)
    formulas = [closed_form(spectrum, replace(contact, rho=rho)) for rho in trial.ranges]
    whole, ratios = closed_form(spectrum, contact).force, []
    for side in SIDES:
        cutoffs = list(trial.cutoffs[side])
        parts = (filtered_spectrum(spectrum, side, cutoff) for cutoff in cutoffs)
        forces = [closed_form(part, contact).force / whole for part in parts]
        ratios.append(xr.DataArray(forces, {"cutoff_wavelength": cutoffs}))
    ratio: xr.DataArray = xr.concat(ratios, "side", join="outer")
    ratio["cutoff_wavelength"].attrs["units"] = "nm"
    found = edges(spectrum, contact, trial.tolerance)
    return xr.Dataset(
        {
            "whole_force": ("rho", [one.force for one in formulas], {"units": "N"}),
            "whole_freezing": ("rho", [one.freezing for one in formulas], {"units": "1"}),
            "regime": ("rho", [one.regime for one in formulas]),
            "edge": ("side", np.array(found), {"units": "nm"}),
            "filtered_ratio": ratio.assign_coords(side=list(SIDES)).assign_attrs(units="1"),
        }
    )
