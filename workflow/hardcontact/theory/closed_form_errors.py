"""Errors of the closed form: its forces relative to those computed on random surfaces."""

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
from hardcontact.theory.summits import spectrum_between

#: Sources of the height of the apex: expected from the spectrum, or computed contacts.
APEX_HEIGHT_SOURCES = ["spectrum", "contacts"]


@dataclass(frozen=True)
class Trial:
    """Random surfaces and contacts on which the closed form is validated."""

    pixels: int  #: Along an edge of each periodic surface.
    realizations: int  #: Number of surfaces of each size.
    sizes: tuple[float, ...]  #: Edges of the surfaces in nm.
    ranges: tuple[float, ...]  #: Ranges of adhesion in nm.
    contact: Contact
    work: float  #: W in J/m².
    rho: float  #: The range (nm) of the edges.
    tolerance: float  #: Relative change of the force that defines an edge.
    confidence: float  #: Confidence of the intervals.
    seed: int  #: Selects the random surfaces.


def spectrum_of_grid(spectrum: Spectrum, size: float, pixels: int) -> Spectrum:
    """Return the spectrum of the waves that a periodic surface can have.

    The wavevectors of the surface fill a square up to the Nyquist wavevector; the cell at zero is
    left out. The spectrum ends at circles of the same areas as this square and this cell.

    spectrum: c_iso in nm⁴.
    size: edge of the surface in nm.
    pixels: pixels along the edge.
    Returns the waves between both circles.
    Raises ValueError if the spectrum has no such waves.
    """
    cell = 2 * np.pi / size
    waves = spectrum_between(spectrum, cell / np.sqrt(np.pi), pixels * cell / np.sqrt(np.pi))
    if waves is None:
        raise ValueError(f"expected waves between {size / pixels:g} and {size:g} nm, found none")
    return waves


def closed_form_errors(spectra: Mapping[str, Spectrum], trial: Trial) -> xr.Dataset:
    """Return computed and predicted forces, and the predictions for all scales.

    spectra: c_iso in nm⁴ by name of the surface.
    trial: random surfaces and contacts on which the closed form is validated.
    Returns by (surface, map_size, rho): ``computed_force`` in N, the mean plastic force over
        contacts and realizations, with its interval over realizations. By source
        (APEX_HEIGHT_SOURCES), too: ``predicted_force`` and ``first_term_force`` in N, and
        ``predicted_over_computed``, the predicted force relative to the computed force. For the
        unfiltered spectra: ``all_scales_freezing`` and ``regime`` (surface, rho), and ``edge``
        (surface, side) in nm.
    """
    errors_by_size = [
        [_compare(name, spectrum, size, trial) for size in trial.sizes]
        for name, spectrum in spectra.items()
    ]
    grids = xr.combine_nested(errors_by_size, ["surface", "map_size"], combine_attrs="override")
    all_scales = [_describe_all_scales(spectrum, trial) for spectrum in spectra.values()]
    return (
        grids.merge(xr.concat(all_scales, "surface", combine_attrs="override"))
        .assign_coords(
            surface=list(spectra),
            map_size=("map_size", list(trial.sizes), {"units": "nm"}),
            rho=("rho", list(trial.ranges), {"units": "nm", "long_name": "range of adhesion"}),
            source=APEX_HEIGHT_SOURCES,
            side=list(SIDES),
        )
        .assign_attrs(range_of_adhesion=trial.rho, confidence=trial.confidence)
    )


def _compare(name: str, spectrum: Spectrum, size: float, trial: Trial) -> xr.Dataset:
    """Return computed and predicted forces of one surface and size of map."""
    pixel_size = size / trial.pixels
    forces = []
    apex_heights = []
    for realization in range(trial.realizations):
        rng = generator(trial.seed, name, f"{size:g}", realization, "closed form")
        surface = random_surface(rng, trial.pixels, pixel_size, spectrum)
        contact_bodies = bodies(surface, None, trial.contact)
        plastic = pull_off_of_pair(contact_bodies, trial.contact, trial.ranges).sel(
            contact_model="plastic"
        )
        forces.append(plastic["pull_off_force"].values.mean(axis=(1, 2)) * trial.work)
        apex_heights.append(plastic["apex_height"].values)
    waves = spectrum_of_grid(spectrum, size, trial.pixels)
    area = trial.contact.pixel_count(pixel_size) * pixel_size**2
    contacts = [
        contact_of_area(trial.contact.radius, rho, trial.work, area) for rho in trial.ranges
    ]
    forms = [
        [closed_form(waves, contact, heights) for contact in contacts]
        for heights in (None, np.array(apex_heights))
    ]
    smooth = forms[0][0].force / forms[0][0].relative
    realizations = xr.DataArray(np.array(forces), dims=("realization", "rho"))
    computed = realizations.mean("realization")
    interval = student_log_interval(realizations, trial.confidence, "realization")
    predicted = [[form.force for form in row] for row in forms]
    first_term = [[form.first_term * smooth for form in row] for row in forms]
    dims = ("source", "rho")
    newton = {"units": "N"}
    return xr.Dataset(
        {
            "computed_force": computed.assign_attrs(newton),
            "computed_force_interval": interval.assign_attrs(newton),
            "predicted_force": (dims, predicted, newton),
            "first_term_force": (dims, first_term, newton),
            "predicted_over_computed": (dims, predicted / computed.values, {"units": "1"}),
        }
    )


def _describe_all_scales(spectrum: Spectrum, trial: Trial) -> xr.Dataset:
    """Return regime and edges by the closed form for a spectrum of all scales."""
    contact = replace(trial.contact, range=trial.rho, work=trial.work)
    forms = [closed_form(spectrum, replace(contact, range=rho)) for rho in trial.ranges]
    return xr.Dataset(
        {
            "all_scales_freezing": ("rho", [form.freezing for form in forms], {"units": "1"}),
            "regime": ("rho", [form.regime for form in forms]),
            "edge": ("side", list(edges(spectrum, contact, trial.tolerance)), {"units": "nm"}),
        }
    )
