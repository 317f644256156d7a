"""What limits the force of a surface, in words: its scans, their size and pixels, the window."""

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import measurements
from hardcontact.answer.force_curve import at_range
from hardcontact.answer.quantities import print_length

__all__ = ["FEW_PIXELS", "OPPOSITE", "of_blind_scans", "of_pixels", "of_scan_size", "of_window"]

#: Share of the force on a smooth sphere that a window holds as good as whole.
WHOLE = 0.99

#: Pixels in contact below which their area, a whole number of them, may be off by more than 5 %.
FEW_PIXELS = 10

#: What errors of both signs leave of a force.
OPPOSITE = (
    "The window makes the force too low, the small scan too high; neither error is known well "
    "enough to correct it, so the force is a rough guess."
)


def of_blind_scans(spectra: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return that the scans of the contacts, which their pixels tell, are reliable nowhere."""
    known = measurements(spectra)
    of_contact = (known["kind"].values.astype(str) == "map") & np.isclose(
        known["pixel_size"].values ** 2, force["pixel_area"].item()
    )
    reliable = (known["reliable"].values == 1).any(axis=1)
    if reliable[of_contact].any() or not of_contact.any():
        return []
    return [
        "The scans that contacts are made on are reliable at no wavelength: the force on them says "
        "little of that on the surface."
    ]


def of_window(force: xr.Dataset) -> list[str]:
    """Return that the window holds too little of the force, at the range asked for or others."""
    rho, share = force["rho"].values, force["window_share"].values
    here = at_range(force)
    if here["window_share"] < WHOLE:
        place, where = here["rho"].item(), "Forces"
        held = here["window_share"].item()
    elif (share < WHOLE).any():
        place, held = rho.max(), share.min()
        where = f"From a range of adhesion of {print_length(rho[share < WHOLE].min())} on forces"
    else:
        return []
    return [
        f"{where} come out too low: the window of {print_length(force.attrs['window'])} holds "
        f"{held:.0%} of the force on a smooth sphere at a range of {print_length(place)}."
    ]


def of_scan_size(force: xr.Dataset) -> list[str]:
    """Return that scans are smaller than contacts need, by how much that raises forces."""
    note = str(force["finite_scan_note"].item())
    return [note] if note else []


def of_pixels(force: xr.Dataset) -> list[str]:
    """Return that few pixels carry the preload, or one that is larger than need be."""
    area, pixel = force.attrs["contact_area"], force["pixel_area"].item()
    if area >= FEW_PIXELS * pixel:
        return []
    if area >= pixel:
        return [
            f"The preload is carried by {area:.3g} nm², {area / pixel:.3g} pixels of the scans "
            f"({pixel:.3g} nm²): the area in contact is known to half a pixel at best."
        ]
    return [
        f"The preload is carried by {area:.3g} nm², less than a pixel of the scans "
        f"({pixel:.3g} nm²): one pixel touches, hardness and preload do not matter, and the "
        "shorter the range of adhesion, the more of the force is that of this pixel."
    ]
