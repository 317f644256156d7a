# The configuration and the paths of all rules, and the code that a script really uses.

from hardcontact.base.code import PINS, code_inputs, template_inputs
from hardcontact.base.origin import canonical
from hardcontact.config import start
from hardcontact.config.patterns import PUBLISHED_TABLES, study_patterns
from hardcontact.config.model import PAPER

STUDY = start.checked_configuration(workflow, config)
PATTERNS = study_patterns(STUDY)
RANGES = sorted({*STUDY["adhesion"]["ranges"], STUDY["scales"]["range"]})
#: How intervals follow from random samples.
SAMPLING = STUDY["inference"] | {"seed": STUDY["seed"]}
COMPARED = STUDY["published"] == PAPER


def parameters(**values):
    """Return the parameters of a script, by their names, as one text."""
    return canonical(values)
