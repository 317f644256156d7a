"""The statements of the paper, and how they are judged by the numbers of a study."""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from paper_datasets import CONFIDENCE

from hardcontact.claims.evaluation import evaluate, read_statements, values
from hardcontact.records import published

TABLES = Path(__file__).parents[1] / "resources" / "paper"
INSIGHT_STATEMENTS = read_statements(TABLES / "insight_claims.csv")
PAPER_STATEMENTS = read_statements(TABLES / "claims.csv")
#: Those of both tables.
STATEMENTS = pd.concat([PAPER_STATEMENTS, INSIGHT_STATEMENTS], ignore_index=True)
CONSTANTS = published.constants(TABLES / "parameters.csv")
PARAMETERS = CONSTANTS["value"]
#: The dataset `paper` of claims.
NUMBERS = xr.Dataset(PARAMETERS.to_dict())


def make_sets(datasets, multiples=(0.999, 1.0, 1.001), statements=STATEMENTS):
    """Sets like sets.nc: the numbers of the replicated claims, times each multiple."""
    replicated = statements[statements["replicated"] == "yes"]
    numbers = values(replicated, datasets, CONSTANTS)
    return xr.Dataset(
        {"value": (("set", "claim"), np.outer(multiples, numbers))}, {"claim": list(numbers.index)}
    )


def judge(statements, datasets, confidence=CONFIDENCE, sets=None):
    """Return the claims with their verdicts; the sets are alike unless others are given."""
    sets = make_sets(datasets, statements=statements) if sets is None else sets
    return evaluate(statements, datasets, CONSTANTS, confidence, sets, seed=1)


def judge_one(name, datasets, sets=None, **changes):
    """Return the row of one claim, of which some columns may be changed."""
    claim = STATEMENTS[STATEMENTS["id"] == name].assign(**changes)
    return judge(claim, datasets, sets=sets).iloc[0]


def near(number, expected, **tolerance):
    """Expect the value of a number."""
    np.testing.assert_allclose(np.asarray(number["value"]), expected, **tolerance)
