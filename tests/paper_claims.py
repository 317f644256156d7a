"""The statements and the numbers of the paper."""

import pandas as pd
from repository import ROOT

from hardcontact.claims.evaluation import read_statements
from hardcontact.records import published

TABLES = ROOT / "resources/paper"
INSIGHT_STATEMENTS = read_statements(TABLES / "insight_claims.csv")
PAPER_STATEMENTS = read_statements(TABLES / "claims.csv")
#: Those of both tables.
STATEMENTS = pd.concat([PAPER_STATEMENTS, INSIGHT_STATEMENTS], ignore_index=True)
CONSTANTS = published.constants(TABLES / "parameters.csv")
PARAMETERS = CONSTANTS["value"]
