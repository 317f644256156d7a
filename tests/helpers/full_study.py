"""The numbers of a finished study that a study with fewer repetitions should find as well.

    python tests/helpers/full_study.py results/paper > tests/full_study.csv

makes the table of the full study, with which tests compare the quick study.
"""

import json
import sys
from pathlib import Path

import pandas as pd

#: The table of the full study.
TABLE = Path(__file__).parents[1] / "full_study.csv"
#: Claims on edges, on forces at the published range and work of adhesion, and on both.
CLAIMS = (
    "short_edge_first", "short_edge_mean", "long_edge_first", "long_edge_mean",
    "mean_force_polished_uncd", "mean_force_uncd", "mean_force_ncd", "mean_force_mcd",
    "range_of_adhesion", "work_of_adhesion", "range_moves_short_edge",
    "plasticity_moves_short_edge",
)  # fmt: skip
EDGES = ("short_edge", "long_edge")


def study_numbers(results):
    """Return the numbers of a study with their intervals and, for claims, their verdicts, by id."""
    claims = pd.read_csv(Path(results, "claims.csv")).set_index("id").loc[list(CLAIMS)]
    claims = claims.rename(columns={"computed": "value"})
    quantities = pd.DataFrame(json.loads(Path(results, "answer.json").read_text())["quantities"])
    edges = quantities[quantities["name"].isin(EDGES) & (quantities["surface"] != "")]
    edges = edges.set_index(edges["name"] + "_" + edges["surface"]).rename_axis("id")
    columns = ["value", "low", "high", "unit", "verdict"]
    return pd.concat([claims.reindex(columns=columns), edges.reindex(columns=columns)])


def read_full_study():
    """Return the numbers of the full study, by id."""
    return pd.read_csv(TABLE).set_index("id")


if __name__ == "__main__":
    study_numbers(sys.argv[1]).to_csv(sys.stdout, float_format="%.6g")
