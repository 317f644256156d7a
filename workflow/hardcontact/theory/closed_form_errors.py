"""The closed form beside forces computed on random surfaces of the same spectrum."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from hardcontact.base.random import generator
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.contact import Contact, contact_of_area
from hardcontact.contact.geometry import bodies
from hardcontact.contact.pull_off import pull_off_of_pair
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.synthesis import SIDES, random_surface
from hardcontact.theory.closed_form import closed_form, edges
from hardcontact.theory.summits import banded

#: Where closest approach comes from.
SOURCES = ["spectrum", "contacts"]


@dataclass(frozen=True)
class Trial:
    """Random surfaces that the closed form is held to, and what touches them."""

    pixels: int  #: Of each periodic surface along an edge.
    realizations: int  #: Surfaces of each size.
    sizes: tuple[float, ...]  #: Edges of the surfaces in nm.
    ranges: tuple[float, ...]  #: Of adhesion in nm.
    contact: Contact
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

    Parameters
    ----------
    spectra : mapping of str to Spectrum
        Of each surface, by its name.
    trial : Trial
        Random surfaces and contacts that the closed form is compared on.

    Returns
    -------
    xarray.Dataset
        Over (surface, map_size, rho): ``computed_force`` in N, mean plastic force over contacts and
        realizations with its interval over realizations; also over source ("spectrum": closest
        approach expected, "contacts": that computed) ``predicted_force``, ``first_term_force`` (N)
        and ``error``, predicted over computed. Of the whole spectra ``whole_freezing`` and
        ``regime`` over (surface, rho), and ``edge`` (surface, side) in nm.
    """
    compared = [
        [_compare(name, spectrum, size, trial) for size in trial.sizes]
        for name, spectrum in spectra.items()
    ]
    grids = xr.combine_nested(compared, ["surface", "map_size"], combine_attrs="override")
    whole = [_describe_whole(spectrum, trial) for spectrum in spectra.values()]
    return (
        grids.merge(xr.concat(whole, "surface", combine_attrs="override"))
        .assign_coords(
            surface=list(spectra),
            map_size=("map_size", list(trial.sizes), {"units": "nm"}),
            rho=("rho", list(trial.ranges), {"units": "nm", "long_name": "range of adhesion"}),
            source=SOURCES,
            side=list(SIDES),
        )
        .assign_attrs(range_of_adhesion=trial.rho, confidence=trial.confidence)
    )


def _compare(name: str, spectrum: Spectrum, size: float, trial: Trial) -> xr.Dataset:
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
    contacts = [
        contact_of_area(trial.contact.radius, rho, trial.work, area) for rho in trial.ranges
    ]
    forms = [
        [closed_form(waves, contact, heights) for contact in contacts]
        for heights in (None, np.array(approaches))
    ]
    smooth = forms[0][0].force / forms[0][0].relative
    realizations = xr.DataArray(np.array(forces), dims=("realization", "rho"))
    computed = realizations.mean("realization")
    interval = student_log_interval(realizations, trial.confidence, "realization")
    predicted = [[form.force for form in row] for row in forms]
    first_term = [[form.first_term * smooth for form in row] for row in forms]
    over, newton, one = ("source", "rho"), {"units": "N"}, {"units": "1"}
    return xr.Dataset(
        {
            "computed_force": computed.assign_attrs(newton),
            "computed_force_interval": interval.assign_attrs(newton),
            "predicted_force": (over, predicted, newton),
            "first_term_force": (over, first_term, newton),
            "error": (over, predicted / computed.values, one),
        }
    )


def _describe_whole(spectrum: Spectrum, trial: Trial) -> xr.Dataset:
    """Return what the closed form says of a spectrum of all scales."""
    contact = replace(trial.contact, range=trial.rho, work=trial.work)
    forms = [closed_form(spectrum, replace(contact, range=rho)) for rho in trial.ranges]
    return xr.Dataset(
        {
            "whole_freezing": ("rho", [form.freezing for form in forms], {"units": "1"}),
            "regime": ("rho", [form.regime for form in forms]),
            "edge": ("side", list(edges(spectrum, contact, trial.tolerance)), {"units": "nm"}),
        }
    )
