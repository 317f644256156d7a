"""How much of contact and force lies where mirrored scans meet their mirror images."""

import xarray as xr

from hardcontact.numbers.statistics import student_interval


def crease_shares(asperities: xr.Dataset, rho: float, confidence: float) -> xr.Dataset:
    """Return how much of contact and force lies at the creases of mirrored scans, by surface.

    Parameters
    ----------
    asperities : dataset asperities.nc
    rho : range of adhesion in nm, of which the nearest computed one is taken
    confidence : of the intervals over scans

    Returns
    -------
    Shares ``crease_contact`` and ``crease_force`` with intervals, beside the share ``crease_area``
    of the surface. ``contact_distance`` (nm) is the root mean square distance from the apex to the
    closest points of single contacts, beside ``draw_length`` sqrt(2 R sigma/t) (nm), where t is the
    height of the apex in rms heights sigma: points touch at the distance r with a density of
    exp(-t r²/(2 R sigma)).
    """
    at_range = asperities.sel(rho=rho, method="nearest", drop=True)
    names = ["crease_contact", "crease_force"]
    scan_shares = at_range[names].mean("contact", keep_attrs=True)
    squared = (at_range["contact_distance"] ** 2).mean(["scan", "contact"])
    height, approach = at_range["rms_height"].mean("scan"), at_range["closest_approach"]
    draw = 2 * asperities.attrs["sphere_radius"] * height**2 / approach.mean(["scan", "contact"])
    nm = {"units": "nm"}
    shares = scan_shares.mean("scan", keep_attrs=True).assign(
        crease_area=at_range["crease_area"].mean("scan", keep_attrs=True),
        contact_distance=(squared**0.5).assign_attrs(nm),
        draw_length=(draw**0.5).assign_attrs(nm),
    )
    for name in names:
        interval = student_interval(scan_shares[name], confidence, "scan")
        shares[f"{name}_interval"] = interval.clip(0, 1, keep_attrs=True)
    return shares
