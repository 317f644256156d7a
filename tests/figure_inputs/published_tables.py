"""Published tables as figures get them."""

import numpy as np
import pandas as pd
from paper_numbers import MEAN_FORCE, MEDIAN_FORCE, SUBSTRATES, TABLE1


def published_table1() -> pd.DataFrame:
    """Return Table 1."""
    return pd.DataFrame(
        {"surface": surface, "quantity": quantity, "value": value, "uncertainty": uncertainty}
        for quantity, columns in TABLE1.items()
        for surface, value, uncertainty in zip(SUBSTRATES, *columns, strict=True)
    )


def published_pull_off() -> pd.DataFrame:
    """Return published mean and median forces by surface."""
    return pd.DataFrame(
        {"mean_force": MEAN_FORCE, "median_force": MEDIAN_FORCE},
        index=pd.Index(SUBSTRATES, name="surface"),
    )


def published_constants() -> pd.DataFrame:
    """Return the published constants that figures show."""
    values = {
        "range_of_adhesion": (5.6, 0.5),
        "work_of_adhesion": (0.0463, 0.0035),
        "critical_wavelength_small": (43.0, np.nan),
        "critical_wavelength_large": (1800.0, np.nan),
        "indent_depth": (2.0, np.nan),
        "indent_edge_length": (50.0, np.nan),
        "preload_indentation": (20e-6, np.nan),
        "measured_indent_depth_lower_bound": (2.0, np.nan),
        "measured_indent_depth_upper_bound": (10.0, np.nan),
        "measured_indent_size_lower_bound": (150.0, np.nan),
        "measured_indent_size_upper_bound": (300.0, np.nan),
        "scan_pixels": (512.0, np.nan),
    }
    return pd.DataFrame.from_dict(values, orient="index", columns=["value", "uncertainty"])
