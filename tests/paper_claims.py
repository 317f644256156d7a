"""The statements of the paper, and how they are judged by the numbers of a study."""

from pathlib import Path

import numpy as np
import xarray as xr
from paper_datasets import CONFIDENCE

from hardcontact import published
from hardcontact.claims.evaluation import evaluate, read_statements

TABLES = Path(__file__).parents[1] / "resources" / "paper"
STATEMENTS = read_statements(TABLES / "claims.csv")
CONSTANTS = published.constants(TABLES / "parameters.csv")
PARAMETERS = CONSTANTS["value"]
#: The dataset `paper` of claims.
NUMBERS = xr.Dataset(PARAMETERS.to_dict())


def judge(statements, datasets, confidence=CONFIDENCE):
    """Return the claims with their verdicts."""
    return evaluate(statements, datasets, CONSTANTS, confidence)


def judge_one(name, datasets, **changes):
    """Return the row of one claim, of which some columns may be changed."""
    return judge(STATEMENTS[STATEMENTS["id"] == name].assign(**changes), datasets).iloc[0]


def near(number, expected, **tolerance):
    """Expect the value of a number."""
    np.testing.assert_allclose(np.asarray(number["value"]), expected, **tolerance)
