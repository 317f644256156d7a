"""Descriptions of substitutes (`resources/README.md`): their columns, and what Table 1 fills in."""

import pandas as pd

#: Rows of Table 1 that fix the spectrum of scans, and those that fix the tail below their band.
AFM_ROWS = ("afm_rms_height", "afm_rms_slope", "afm_rms_curvature")
TAIL_ROWS = ("all_rms_slope", "all_rms_curvature")

#: Columns that hold numbers.
PARAMETERS = (
    "longest_nm", "shortest_nm", "plateau_nm4", "rolloff_nm", "hurst", "hurst_change",
)  # fmt: skip

#: Models that are calibrated if their Hurst exponent is blank, and the rows of Table 1 they meet.
CALIBRATED = {"self-affine": AFM_ROWS, "varying Hurst": AFM_ROWS, "power law": TAIL_ROWS}

#: Bases of bands that are known; all others are inferred or assumed.
KNOWN = ("published", "measured")


def is_calibrated(bands: pd.DataFrame) -> bool:
    """Return whether a description leaves parameters to Table 1."""
    return bool((bands.hurst.isna() & bands.model.isin(CALIBRATED)).any())
