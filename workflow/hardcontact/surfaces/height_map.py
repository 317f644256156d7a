"""One value for a height map: heights, pixel size, whether it is periodic, its basis.

SurfaceTopography is imported where it is used: importing it takes longer than most jobs compute.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from hardcontact.records import dataset

if TYPE_CHECKING:
    from SurfaceTopography import Topography


@dataclass(frozen=True, eq=False)
class HeightMap:
    """A surface on square pixels; heights grow out of the material.

    Heights (y, x) and the edge of a pixel are in nm. A periodic map continues itself at its edges.
    The basis is ``"measured"`` or ``"substitute"``; a substitute is called so wherever it shows.
    """

    heights: np.ndarray
    pixel_size: float
    periodic: bool
    basis: str

    @property
    def pixels(self) -> int:
        """Pixels along an edge of a square map."""
        return int(self.heights.shape[0])

    @property
    def size(self) -> float:
        """Edge of a square map in nm."""
        return self.pixels * self.pixel_size

    def dataset(self) -> xr.Dataset:
        """Return the map as it is stored: float32 heights with coordinates in nm."""
        coordinates = {
            axis: (
                (axis,),
                (0.5 + np.arange(count)) * self.pixel_size,
                {"units": "nm", "long_name": f"{axis} position"},
            )
            for axis, count in zip("yx", self.heights.shape, strict=True)
        }
        attributes = {
            "units": "nm",
            "long_name": "surface height",
            "pixel_size": float(self.pixel_size),
        }
        return xr.Dataset(
            {"heights": (("y", "x"), self.heights.astype("float32"), attributes)},
            coordinates,
            {"periodic": int(self.periodic), "basis": self.basis},
        )


def read_height_map(path: str) -> HeightMap:
    """Read a netCDF file of `HeightMap.dataset`; one that cannot be read is a ValueError."""
    stored = dataset.read(path)
    heights = stored["heights"]
    return HeightMap(
        heights.values,
        float(heights.attrs["pixel_size"]),
        bool(stored.attrs["periodic"]),
        str(stored.attrs["basis"]),
    )


def library_map(surface: HeightMap) -> "Topography":
    """Return a height map as SurfaceTopography knows it; its first axis is x."""
    from SurfaceTopography import Topography

    sizes = tuple(count * surface.pixel_size for count in surface.heights.T.shape)
    return Topography(np.asarray(surface.heights, dtype=float).T, sizes, unit="nm")
