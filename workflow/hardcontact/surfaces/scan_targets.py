"""What the scans of a substitute are to have together: Table 1, on the pixels of the study."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from hardcontact.surfaces.calibration import AFM_ROWS, rows_met
from hardcontact.surfaces.scan_moments import expected_moments, transfer_weights
from hardcontact.surfaces.spectrum import spectrum_from
from hardcontact.surfaces.substitute_scans import ScanGrid
from hardcontact.surfaces.topography import DEFINITIONS

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Targets", "group_heights", "scan_targets"]

#: Metrics of isotropic surfaces over the moments: height, gradient, half the Laplacian.
OVER_MOMENTS = {
    "rms_height": 1.0,
    "rms_gradient": 1.0,
    "rms_profile_slope": 1 / np.sqrt(2),
    "rms_half_laplacian": 1.0,
    "rms_laplacian": 2.0,
}


class Targets(NamedTuple):
    """What a group of scans of one surface is to have.

    Attributes
    ----------
    means : dict of str to float
        By metric of `topography.METRICS`, in its unit: height, slope, curvature, in this order.
    deviation : float
        Standard deviation of the rms heights (nm, ddof 1).
    rows : tuple of str
        Rows of Table 1 that are met so.
    """

    means: Mapping[str, float]
    deviation: float
    rows: tuple[str, ...]


def scan_targets(
    spectrum: "xr.Dataset",
    table1: pd.DataFrame,
    constants: pd.DataFrame,
    definitions: Mapping[str, str],
    grid: ScanGrid,
) -> Targets | None:
    """Return what scans of a substitute are to have on this study's pixels.

    On the paper's pixels and size it is what the spectrum expects of a scan: Table 1, if the
    spectrum was calibrated to it. On other pixels slope and curvature are those that the spectrum
    expects there, and the rms height stays; on another size all three are expected.

    Parameters
    ----------
    spectrum : xarray.Dataset
        Of `substitute_spectra.substitute_spectrum`.
    table1 : pandas.DataFrame
        Of `rows_of_surface`; empty if the paper has no such surface.
    constants : pandas.DataFrame
        Of `published.constants`: pixels and size of the paper's scans.
    definitions : mapping of str to str
        What `slope` and `curvature` of Table 1 are read as: keys of `topography.DEFINITIONS`.
    grid : ScanGrid
        Of this study.

    Returns
    -------
    Targets or None
        The deviation is the share of the rms height that its published uncertainty is. None of a
        surface that the paper has no rms height of.
    """
    if "afm_rms_height" not in table1.index:
        return None
    published = int(constants["value"]["scan_pixels"]), float(constants["value"]["scan_size"])
    moments = np.array(spectrum.attrs["expected_scan_moments"])
    same_size = math.isclose(grid.size, published[1])
    same_pixels = same_size and grid.pixels == published[0]
    same = np.array([same_size, same_pixels, same_pixels])
    if not same.all():
        density = spectrum_from(spectrum)
        weights = transfer_weights(4 * grid.pixels, grid.pixel_size, grid.pixels)
        moments = np.where(same, moments, expected_moments(density, weights))
    height = table1.loc["afm_rms_height"]
    calibrated = rows_met(spectrum.attrs["calibrated_to_table1"])
    names = "rms_height", *(DEFINITIONS[definitions[key]] for key in ("slope", "curvature"))
    return Targets(
        {
            name: float(OVER_MOMENTS[name] * moment)
            for name, moment in zip(names, moments, strict=True)
        },
        float(moments[0] * height["uncertainty"] / height["value"]),
        tuple(row for row, met in zip(AFM_ROWS, same, strict=True) if met and row in calibrated),
    )


def group_heights(drawn: NDArray[np.float64], mean: float, deviation: float) -> NDArray[np.float64]:
    """Return rms heights of a group of scans of which mean and deviation are exactly as given.

    Scans keep their order and their relative distances. A single scan
    gets the mean.

    Parameters
    ----------
    drawn : numpy.ndarray
        (scan,) rms heights as drawn, in nm.
    mean, deviation : float
        Of the heights asked for, in nm; the deviation that of a sample (n - 1).

    Returns
    -------
    numpy.ndarray
        (scan,) nm.
    """
    deviations = drawn - drawn.mean()
    if len(drawn) > 1:
        deviations *= deviation / deviations.std(ddof=1)
    return np.asarray(mean + deviations)
