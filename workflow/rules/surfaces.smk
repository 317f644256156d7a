# The surfaces of the study, their variants, and the lists of their files.

from hardcontact.config.files import Files
from hardcontact.config.patterns import any_of
from hardcontact.config.patterns import wildcard_constraints as constraints
from hardcontact.config.variants import TABLE1_DEFINITIONS

SELECTION = start.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
NAMED_SURFACES = {"labels": SELECTION.labels, "basis": SELECTION.basis}
FILES = Files(STUDY, SELECTION, PATTERNS)


wildcard_constraints:
    **constraints(SELECTION.surfaces, FILES.surface_variants),
