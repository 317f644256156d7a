# The configuration and the paths of all rules, and the code that a script really uses.

from hardcontact.base.code import code_inputs, page_templates
from hardcontact.base.origin import canonical
from hardcontact.base.packages import PINS
from hardcontact.config import start
from hardcontact.config.configuration import read_yaml
from hardcontact.config.patterns import PUBLISHED_TABLES, study_patterns
from hardcontact.config.model import NONE, PAPER

STUDY = start.checked_configuration(workflow, config)
PATTERNS = study_patterns(STUDY)
RANGES = sorted({*STUDY["adhesion"]["ranges"], STUDY["scales"]["range"]})
#: How intervals follow from random samples.
SAMPLING = STUDY["inference"] | {"seed": STUDY["seed"]}
COMPARED_WITH_PAPER = STUDY["published"] == PAPER
#: Category and title of each page of the report that is no figure.
PAGES = read_yaml("workflow/report/pages.yaml")
#: The answer of a study, and the page that shows it.
ANSWER = {
    "page": report(
        PATTERNS.result("answer.html"),
        caption="../report/answer.rst",
        category="0. Answer",
        labels={"page": "the answer"},
    ),
    "json": PATTERNS.result("answer.json"),
}


def parameters(**values):
    """Return the parameters of a script, by their names, as one text."""
    return canonical(values)
