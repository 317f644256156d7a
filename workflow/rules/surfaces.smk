# The surfaces of the study, their variants, and the lists of their files.

from hardcontact.config.files import Files
from hardcontact.config.patterns import any_of
from hardcontact.config.patterns import wildcard_constraints as constraints
from hardcontact.config.variants import TABLE1_DEFINITIONS

SELECTION = start.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
FILES = Files(STUDY, SELECTION, PATTERNS)


wildcard_constraints:
    **constraints(SELECTION.surfaces, FILES.surface_variants),


def pool_parameters(surface, variant, first, last):
    """Return the parameters of the forces on scans or surfaces with these numbers."""
    return {
        "surface": surface,
        "first": int(first),
        "last": int(last),
        "scans": len(SELECTION.scans(surface)),
        "scan": SCAN_GRID,
        "table1": FILES.surface_variants[variant].table1,
        "amplitudes": STUDY["sets"]["amplitudes"],
        "contact": STUDY["contact"] | {"count": STUDY["sets"]["count"]},
        "ranges": RANGES,
        "radius": STUDY["sphere"]["radius"],
        "seed": STUDY["seed"],
    }
