"""One topography of a file: a height map or a line scan, as it was measured."""

from dataclasses import dataclass

import numpy as np

__all__ = ["Measurement"]


@dataclass(frozen=True)
class Measurement:
    """One topography of a file.

    Attributes
    ----------
    path, dataset : str
        Of the file; the dataset is empty unless the file is a container.
    channel, file_unit : str
        Name of the channel read, and the unit that the file states.
    kind : str
        ``"map"`` or ``"profile"``.
    heights : numpy.ndarray
        In nm, (y, x) of a map and (n,) of a profile, evenly spaced.
    pixel_size : float
        Edge of a pixel of a map, spacing of a profile, in nm.
    tip_radius : float or None
        In nm, if the file or its container states one.
    notes : tuple of str
        What was done to the data, in words.
    undefined : int
        Number of undefined pixels before they were filled.
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
