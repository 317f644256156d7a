"""The judged claims of a study, its claims.csv: columns, reading, open intervals, counts."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.inference.edges import last_cutoff
from hardcontact.paper.claims.verdicts import BY_CONSTRUCTION, EXPERIMENT, VERDICTS

#: Columns of the claims.csv of a study. `evidence` says where the limits of the paper come from,
#: `basis` on which scans the computed number rests.
JUDGED_COLUMNS = (
    "id", "main", "section", "statement", "number", "published", "computed", "low", "high", "unit",
    "rule", "evidence", "accepted_low", "accepted_high", "agreeing_share", "verdict",
    "follows_from", "basis", "note",
)  # fmt: skip
#: Claims about an edge of the band, with its side.
EDGE_CLAIMS = {
    "short_edge_first": "short", "short_edge_mean": "short", "short_edge_mean_at_least": "short",
    "long_edge_first": "long", "long_edge_mean": "long", "long_edge_mean_at_most": "long",
}  # fmt: skip


def read_judged_claims(path: str | Path) -> pd.DataFrame:
    """Read the claims.csv of a study; raise ValueError if it ends within a line."""
    if not Path(path).read_bytes().endswith(b"\n"):
        raise ValueError(
            f"{path}: expected a complete table, found a part of it; delete it and run again"
        )
    text = dict.fromkeys(["main", "unit", "follows_from", "note", "verdict"], str)
    return pd.read_csv(path, dtype=text).fillna(dict.fromkeys(text, ""))


def find_open_end(
    side: str, value: float, low: float, high: float, bands: Sequence[xr.Dataset]
) -> str:
    """Return which end of the interval of an edge (nm) lies beyond the cutoffs of any band.

    It is ``"high"`` for a short edge, ``"low"`` for a long edge, otherwise ``""``. An edge beyond
    the cutoffs counts as the last cutoff, and an interval that is stretched to it is open, too.
    """
    end, limit, sign = ("high", high, 1) if side == "short" else ("low", low, -1)
    last_cutoffs = np.array(
        [last_cutoff(band["filtered_force_change"].sel(side=side), side) for band in bands]
    )
    is_beyond = (sign * value >= sign * last_cutoffs).any()
    is_open = np.isclose(limit, last_cutoffs).any() or (is_beyond and np.isclose(limit, value))
    return end if is_open else ""


def add_open_ends(claims: pd.DataFrame, bands: Sequence[xr.Dataset]) -> pd.DataFrame:
    """Add the column `open_end` to claims: of edges from `find_open_end`, otherwise empty."""
    sides = claims["id"].map(EDGE_CLAIMS)
    rows = zip(sides, claims["computed"], claims["low"], claims["high"], strict=True)
    ends = [find_open_end(*row, bands) if isinstance(row[0], str) else "" for row in rows]
    return claims.assign(open_end=ends)


def without_verdicts(claims: pd.DataFrame) -> pd.DataFrame:
    """Return the claims of a study whose inputs are not the paper's: it judges no statement."""
    return claims.assign(verdict="", agreeing_share=np.nan)


def count_verdicts(claims: pd.DataFrame) -> pd.DataFrame:
    """Count the claims of each of `VERDICTS`, and the independent statements among them.

    A claim is not independent if it follows from another claim, holds by construction, or compares
    the model with measured forces.
    """
    verdicts = claims["verdict"]
    independent = (claims["follows_from"] == "") & ~verdicts.isin([BY_CONSTRUCTION, EXPERIMENT])
    counts = pd.DataFrame(
        {
            "independent": verdicts[independent].value_counts().reindex(VERDICTS, fill_value=0),
            "claims": verdicts.value_counts().reindex(VERDICTS, fill_value=0),
        }
    )
    return counts.rename_axis("verdict").reset_index()
