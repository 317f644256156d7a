"""Read the numbers that the paper prints, from the tables of `resources/paper`.

This module is in the layer `base`, because substitutes need these numbers in every study.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

#: The tables of what the paper prints, by the names under which rules and figures get them.
PUBLISHED_TABLES = {
    "published_constants": "resources/paper/constants.csv",
    "published_pull_off": "resources/paper/pull_off.csv",
    "published_table1": "resources/paper/table1.csv",
}
#: The statements of the paper.
CLAIMS = "resources/paper/claims.csv"


def effective_modulus(constants: Mapping[Any, Any]) -> float:
    """Return the effective modulus E* (Pa) of both bodies from the values of `constants.csv`."""
    return 1 / sum(
        (1 - float(constants[f"{body}_poisson_ratio"]) ** 2)
        / float(constants[f"{body}_youngs_modulus"])
        for body in ("sphere", "substrate")
    )


def read_constants(path: str | Path) -> pd.DataFrame:
    """Read `constants.csv`, single numbers of the paper, by quantity."""
    return pd.read_csv(path, index_col="quantity")


def read_published_forces(path: str | Path, dtype: type[str] | None = None) -> pd.DataFrame:
    """Read `pull_off.csv`: the statistics of pull-off forces that the paper prints, by surface.

    The `dtype` str keeps the printed digits as text.
    """
    table = pd.read_csv(path, dtype=dtype)
    return table.pivot(index="surface", columns="quantity", values="value")


def read_table1(path: str | Path) -> pd.DataFrame:
    """Read `table1.csv`: the roughness metrics of Table 1, one row per number and surface."""
    return pd.read_csv(path)


def surfaces_of_table1() -> set[str]:
    """Return the surfaces whose rms height is in Table 1."""
    table1 = read_table1(PUBLISHED_TABLES["published_table1"])
    return set(table1.surface[table1.quantity == "afm_rms_height"])


def rows_of_surface(table1: pd.DataFrame, surface: str) -> pd.DataFrame:
    """Return the rows of a surface in Table 1, by quantity."""
    return table1[table1["surface"] == surface].set_index("quantity")
