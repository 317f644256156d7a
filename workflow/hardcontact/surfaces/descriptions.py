"""Descriptions of the spectra of substitutes: the segments of a table in resources/spectra."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd

from hardcontact.base.arrays import Floats
from hardcontact.surfaces.spectrum import self_affine, smooth_rolloff, varying_hurst

#: Models in descriptions of substitutes (`resources/README.md`), with their parameter columns.
SPECTRAL_MODELS: dict[str, tuple[Callable[..., Floats], tuple[str, ...]]] = {
    "self-affine": (self_affine, ("plateau_nm4", "rolloff_nm", "hurst")),
    "varying Hurst": (varying_hurst, ("plateau_nm4", "rolloff_nm", "hurst", "hurst_change")),
    "smooth roll-off": (smooth_rolloff, ("plateau_nm4", "rolloff_nm", "hurst")),
}
#: Columns of descriptions that hold numbers.
DESCRIPTION_NUMBERS = (
    "longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst", "hurst_change",
)  # fmt: skip
#: Rows of Table 1 to which the spectrum of scans, and the tail at shorter wavelengths, are fitted.
AFM_ROWS = ("afm_rms_height", "afm_rms_slope", "afm_rms_curvature")
TAIL_ROWS = ("all_rms_slope", "all_rms_curvature")
#: Rows of Table 1 to which a model is calibrated if its Hurst exponent is blank.
CALIBRATION_ROWS = {"self-affine": AFM_ROWS, "varying Hurst": AFM_ROWS, "power law": TAIL_ROWS}
#: Values of `evidence` for segments that come from data; other segments are inferred or assumed.
DATA_EVIDENCE = ("published", "measured")


def read_segments(path: str | Path) -> pd.DataFrame:
    """Read the segments of a description of a spectrum, without blanks around its cells."""
    cells = pd.read_csv(path, dtype=str).apply(lambda column: column.str.strip())
    segments: pd.DataFrame = cells.replace("", np.nan).astype(
        dict.fromkeys(DESCRIPTION_NUMBERS, float)
    )
    return segments


def needs_calibration(segments: pd.DataFrame) -> bool:
    """Return True if a description leaves parameters to a calibration on Table 1."""
    return bool((segments.hurst.isna() & segments.model.isin(CALIBRATION_ROWS)).any())
