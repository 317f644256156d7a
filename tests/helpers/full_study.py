"""The numbers of a finished study that a study with fewer random surfaces should find as well.

    python tests/helpers/full_study.py results/paper

writes what the repository keeps of the full study: the table with which tests compare the quick
study and resources/adhesion, and the page and the figure of the README.
"""

import json
import shutil
import sys
from pathlib import Path

import pandas as pd
import xarray as xr
from repository import ROOT

#: The table of the full study.
TABLE = ROOT / "tests/full_study.csv"
#: Files of a study that the README shows.
SHOWN_FILES = ("answer.html", "figures/fig6.png")
#: Claims on edges, on forces at the published range and work of adhesion, and on both.
CLAIMS = (
    "outermost_short_edge", "averaged_short_edge", "outermost_long_edge", "averaged_long_edge",
    "mean_force_polished_uncd", "mean_force_uncd", "mean_force_ncd", "mean_force_mcd",
    "range_of_adhesion", "work_of_adhesion", "range_moves_short_edge",
    "plasticity_moves_short_edge",
)  # fmt: skip
EDGES = ("short_edge", "long_edge")
#: The best ranges (nm) of the sets lie in two groups, below and above this one.
LIMIT_OF_GROUPS = 5.0


def study_numbers(results):
    """Return the numbers of a study with their intervals and, for claims, their verdicts, by id."""
    claims = pd.read_csv(Path(results, "claims.csv")).set_index("id").loc[list(CLAIMS)]
    claims = claims.rename(columns={"computed": "value"})
    quantities = pd.DataFrame(json.loads(Path(results, "answer.json").read_text())["quantities"])
    edges = quantities[quantities["name"].isin(EDGES) & (quantities["surface"] != "")]
    edges = edges.set_index(edges["name"] + "_" + edges["surface"]).rename_axis("id")
    columns = ["value", "low", "high", "unit", "verdict"]
    tables = (claims, edges, best_pairs(results))
    return pd.concat([table.reindex(columns=columns) for table in tables])


def best_pairs(results):
    """Return the median best range and work of each group of sets, and its share of the sets."""
    sets = xr.open_dataset(Path(results, "sets.nc")).sel(contact_model="plastic")
    is_long = sets["range_of_adhesion"] > LIMIT_OF_GROUPS
    rows = {}
    for pair, is_chosen in (("long_range", is_long), ("short_range", ~is_long)):
        chosen_sets = sets.where(is_chosen, drop=True)
        rows[f"{pair}.range_of_adhesion"] = chosen_sets["range_of_adhesion"].median().item(), "nm"
        rows[f"{pair}.work_of_adhesion"] = chosen_sets["work_of_adhesion"].median().item(), "J/m2"
        rows[f"{pair}.share_of_sets"] = is_chosen.mean().item(), "1"
    return pd.DataFrame.from_dict(rows, "index", columns=["value", "unit"]).rename_axis("id")


def read_full_study():
    """Return the numbers of the full study, by id."""
    return pd.read_csv(TABLE).set_index("id")


if __name__ == "__main__":
    study_numbers(sys.argv[1]).to_csv(TABLE, float_format="%.6g")
    for name in SHOWN_FILES:
        shutil.copy(Path(sys.argv[1], name), ROOT / "resources/readme")
