"""The statements and the numbers of the paper."""

import pandas as pd
from repository import ROOT

from hardcontact.base import published
from hardcontact.paper.evaluation import read_statements

TABLES = ROOT / "resources/paper"
INSIGHT_STATEMENTS = read_statements(TABLES / "insight_claims.csv")
PAPER_STATEMENTS = read_statements(TABLES / "claims.csv")
#: Those of both tables.
STATEMENTS = pd.concat([PAPER_STATEMENTS, INSIGHT_STATEMENTS], ignore_index=True)
CONSTANTS = published.constants(TABLES / "parameters.csv")
PARAMETERS = CONSTANTS["value"]
