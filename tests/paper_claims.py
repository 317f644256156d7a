"""The statements and the numbers of the paper."""

from repository import ROOT

from hardcontact.base import published
from hardcontact.paper.evaluation import read_statements

TABLES = ROOT / "resources/paper"
STATEMENTS = read_statements(TABLES / "claims.csv")
CONSTANTS = published.constants(TABLES / "parameters.csv")
PARAMETERS = CONSTANTS["value"]
