"""One value for a measured topography: heights, spacing and what its file says of it."""

from dataclasses import dataclass

import numpy as np

__all__ = ["Measurement"]


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
