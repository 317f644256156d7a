"""What moves the range of adhesion of the sets: rank correlations with facts of their scans."""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from scipy import stats

from hardcontact.figures import style

__all__ = ["CONFIDENCE", "correlations", "draw_correlations", "name_fact", "strongest"]

#: Printed names of the facts, and their units. Every set of several substitute scans has the
#: heights of Table 1.
FACTS = {
    "rms_height": ("height", "nm"),
    "rms_height_std": ("height, sd", "nm"),
    "rms_gradient": ("slope", ""),
    "rms_gradient_std": ("slope, sd", ""),
    "rms_half_laplacian": ("curvature", "nm⁻¹"),
    "rms_half_laplacian_std": ("curvature, sd", "nm⁻¹"),
}
CONFIDENCE = 0.95
FEWEST_SETS = 5  # fewer have no correlation worth showing
LEAST_SPREAD = 1e-6  # over the sets, of a fact that can move anything, as a share of its mean


def correlations(of_sets: xr.Dataset) -> pd.DataFrame:
    """Return the rank correlation over the sets of each fact with the range of adhesion.

    Columns: `quantity` (the fact), `surface`, `value`, Spearman's coefficient, and its interval
    `low`, `high` by Fisher's transformation. Facts that are the same in all sets are left out.
    """
    count, rows = of_sets.sizes["set"], []
    for name in FACTS if count >= FEWEST_SETS else ():
        for surface in map(str, of_sets["surface"].values):
            fact = of_sets[name].sel(surface=surface).values
            if fact.std() > LEAST_SPREAD * abs(fact.mean()):
                value = stats.spearmanr(fact, of_sets["range_of_adhesion"].values).statistic
                rows.append({"quantity": name, "surface": surface, **_with_bounds(value, count)})
    return pd.DataFrame(rows, columns=["quantity", "surface", "value", "low", "high"])


def _with_bounds(value: float, count: int) -> dict[str, float]:
    """Return a rank correlation of `count` pairs with its interval.

    The variance of its Fisher transform is 1.06/(count - 3) (Fieller, Hartley and Pearson 1957).
    """
    half = stats.norm.ppf((1 + CONFIDENCE) / 2) * np.sqrt(1.06 / (count - 3))
    low, high = np.tanh(np.arctanh(np.clip(value, -0.999999, 0.999999)) + [-half, half])
    return {"value": float(value), "low": float(low), "high": float(high)}


def strongest(rows: pd.DataFrame) -> pd.Series | None:
    """Return the row of `correlations` of the largest absolute value; None if there is none."""
    known = rows.dropna(subset="value")
    return None if known.empty else known.iloc[int(known["value"].abs().argmax())]


def name_fact(row: pd.Series, label: str) -> str:
    """Return the printed name and unit of the fact of a row, given the label of its surface."""
    name, unit = FACTS[row["quantity"]]
    return f"rms {name}, of {label}" + (f" ({unit})" if unit else "")


def draw_correlations(axes: Axes, rows: pd.DataFrame, surfaces: list[str]) -> None:
    """Draw a bar for each rank correlation, by fact and, within it, by surface, of its colour."""
    colours, most = style.colours(surfaces), strongest(rows)
    facts = [name for name in FACTS if name in set(rows["quantity"])]
    step = 0.8 / len(surfaces)
    for index, row in rows.iterrows():
        place = facts.index(row["quantity"]) + step * (surfaces.index(row["surface"]) + 0.5) - 0.4
        edge: dict[str, Any] = {"edgecolor": "black", "linewidth": 1.2}
        axes.barh(
            place,
            row["value"],
            step,
            color=colours[row["surface"]],
            **(edge if most is not None and index == most.name else {}),
        )
        axes.plot([row["low"], row["high"]], [place] * 2, color="0.2", lw=0.8)
    axes.axvline(0, color="0.3", lw=0.6)
    axes.set_yticks(range(len(facts)), [FACTS[name][0] for name in facts])
    axes.set(xlim=(-1, 1), xlabel="rank correlation with ρ")
    axes.set_ylim(max(len(facts), 1) - 0.4, -0.6)
