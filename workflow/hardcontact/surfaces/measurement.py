"""One value for a measured topography: heights, spacing and what its file says of it.

What a scan may be: limits on files, pixels, lengths and slopes, and refusals beyond them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "FILE_LIMIT",
    "LENGTHS",
    "Measurement",
    "PIXELS",
    "POINTS",
    "RefusedScan",
    "check_lengths",
    "check_points",
    "unit_in_nm",
]


@dataclass(frozen=True)
class Measurement:
    """One topography of a file: a map or a line scan.

    Attributes
    ----------
    path : str
        The file.
    dataset : str
        The data file in a container; empty for any other file.
    channel : str
        Name of the channel that was read.
    file_unit : str
        Unit of length that the file, or its container, states.
    kind : str
        ``"map"`` or ``"profile"``.
    heights : numpy.ndarray
        (y, x), or (n,) of a profile, in nm, on uniform spacing and without gaps.
    pixel_size : float
        In nm; of a profile its spacing.
    tip_radius : float or None
        In nm, if the file or its container states one.
    notes : tuple of str
        What was changed or chosen in reading, in words for the user.
    undefined : int
        Undefined pixels among those kept, before they were filled.
    """

    path: str
    dataset: str
    channel: str
    file_unit: str
    kind: str
    heights: np.ndarray
    pixel_size: float
    tip_radius: float | None
    notes: tuple[str, ...]
    undefined: int


#: Pixels along an edge of a map: substitutes have no fewer, and masters at least twice as many.
PIXELS = (16, 8192)
#: Points of a line scan, as read and as resampled.
POINTS = (16, 2**20)
#: The largest file, or archive once unpacked, in bytes.
FILE_LIMIT = 2**30
#: Pixels and heights of a scan in nm, 1 pm to 1 cm: the range of all microscopes, and squares of
#: these keep their digits. A damaged header may state any number.
LENGTHS = (1e-3, 1e7)
#: The largest mean slope: no tip follows 84 degrees; heights read from a wrong place in a file
#: are steeper.
SLOPE_LIMIT = 10


class RefusedScan(Exception):
    """A scan that cannot be used; the text says what was expected and what was found."""


def check_points(counts: tuple[int, ...]) -> None:
    """Refuse a map (x, y) or a line scan (n,) of too few or too many points."""
    least, most = PIXELS if len(counts) == 2 else POINTS
    if not least <= min(counts) <= max(counts) <= most:
        found = " x ".join(map(str, counts))
        where = "pixels along an edge" if len(counts) == 2 else "points along a line scan"
        raise RefusedScan(f"expected {least} to {most} {where}, found {found}")


def check_lengths(heights: NDArray[np.float64], pixel_size: float) -> None:
    """Refuse heights and a pixel size, both in nm, that no scan has."""
    low, high = heights.min(), heights.max()
    least, most = LENGTHS
    if (
        not least <= pixel_size <= most
        or not max(-low, high) <= most  # also true of what is no number
        or 0 < high - low < least
    ):
        raise RefusedScan(
            f"expected pixels and differences of height from {least:g} to {most:g} nm, "
            f"found pixels of {pixel_size:.6g} nm and heights from {low:.6g} to {high:.6g} nm"
        )
    slope = np.abs(np.diff(heights)).mean() / pixel_size
    if slope > SLOPE_LIMIT:
        raise RefusedScan(f"expected a mean slope of at most {SLOPE_LIMIT}, found {slope:.3g}")


def unit_in_nm(unit: str) -> float:
    """Return a unit of length in nm; any other unit is refused."""
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    try:
        return float(get_unit_conversion_factor(unit, "nm"))
    except ValueError:
        raise RefusedScan(f"expected a unit of length, found {unit!r}") from None
