"""The predicted pull-off forces of own surfaces, with all that is said of them: force.nc."""

import xarray as xr

from hardcontact.adhesion.finite_scan import (
    with_contact_area,
    with_finite_scans,
    with_window_share,
)
from hardcontact.insight.closed_form import Contact
from hardcontact.insight.edge_scaling import among_regimes
from hardcontact.insight.pull_off_statistics import force_scatter
from hardcontact.insight.summits import draw_size
from hardcontact.own_surfaces.master_forces import Masters
from hardcontact.own_surfaces.predicted_force import (
    continued_force,
    predicted_force,
    with_continued_force,
    with_smooth_bound,
)
from hardcontact.surfaces.spectrum import spectrum_from


def own_force(
    adhesion: xr.Dataset,
    scales: xr.Dataset,
    topography: xr.Dataset,
    spectra: xr.Dataset,
    *,
    contact: Contact,
    masters: Masters,
    window: float,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return the predicted forces of all surfaces, and what limits and scatters them.

    Parameters
    ----------
    adhesion, scales, topography, spectra : xarray.Dataset
        As in the files of these names.
    contact : Contact
        Radius of the sphere, and range, work and area of the contact that is asked for.
    masters : Masters
        What the masters of `scales` are made of.
    window : float
        Edge of the window of a contact, in nm.
    tolerance : float
        Relative change of the force that counts as none.
    confidence : float
        Of all intervals.

    Returns
    -------
    xarray.Dataset
        Over surface: the forces on the scans (`predicted_force`) and with continued roughness
        (`continued_force`), never above that of a smooth sphere; whether scans, windows and pixels
        are large or small enough (`finite_scan`); the scatter of single forces (`force_scatter`);
        and the place among the regimes (`among_regimes`).
    """
    sizes = {str(name): size for name, size in topography["scan_size"].to_series().items()}
    force = predicted_force(
        adhesion,
        work=contact.work,
        rho=contact.rho,
        sizes=sizes,
        confidence=confidence,
    )
    continued = continued_force(scales, masters, contact.work, confidence)
    force = with_continued_force(force, continued, tolerance)
    force = with_smooth_bound(force, contact.area)
    joined = {
        name: spectrum_from(spectra.sel(surface=name)) for name in force["surface"].values.tolist()
    }
    draw_sizes = {
        name: draw_size(spectrum, contact.radius, contact.area) for name, spectrum in joined.items()
    }
    force = with_finite_scans(force, topography, draw_sizes)
    force = with_window_share(force, window, contact.radius)
    scatter = force_scatter(
        joined,
        contact,
        [contact.rho],
        dict.fromkeys(joined, 0.0),  # the scatter over the places of one scan
        tolerance=tolerance,
        confidence=confidence,
    ).squeeze("rho", drop=True)
    force = force.merge(scatter[["modulus", "spread", "contacts_needed"]])
    force = force.merge(among_regimes(joined, contact))
    return with_contact_area(force, topography, contact.area)
