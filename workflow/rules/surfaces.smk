# The surfaces of the study, and the lists of their files.
#
# Names that the rules of all files use:
#   SELECTION      the surfaces of the table, with their labels, scans and source files
#   SPHERE         the name of the sphere's surface
#   NAMED_SURFACES the label of each surface, and whether it was measured or is a substitute
#   FILES          the paths of the files of a surface, and the lists of files of a rule
#   CONTACT        the keys of `contact`, with the radius of the sphere and the range of adhesion (nm)

from hardcontact.files.study_files import Files
from hardcontact.files.patterns import any_name_pattern
from hardcontact.files.patterns import wildcard_constraints as constraints

SELECTION = start.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
NAMED_SURFACES = {"labels": SELECTION.labels, "basis": SELECTION.basis}
FILES = Files(STUDY, SELECTION, PATTERNS)
CONTACT = STUDY["contact"] | {
    "radius": STUDY["sphere"]["radius"],
    "rho": STUDY["scales"]["range"],
}


wildcard_constraints:
    **constraints(SELECTION.surfaces),


def named(surface):
    """Return the name of a surface, its label, and whether it was measured or is a substitute."""
    return {
        "surface": surface,
        "label": SELECTION.labels[surface],
        "basis": SELECTION.basis[surface],
    }


def group_parameters(wildcards):
    """Return the parameters of scans of a pool, or of surfaces with features, and of their contacts."""
    return {
        "surface": wildcards.surface,
        "first": int(wildcards.first),
        "last": int(wildcards.last),
        "scans": len(SELECTION.scans(wildcards.surface)),
        "scan": SCAN_GRID,
        "contact": STUDY["contact"] | {"count": STUDY["sets"]["count"]},
        "ranges": RANGES,
        "radius": STUDY["sphere"]["radius"],
        "seed": STUDY["seed"],
    }


def whole_parameters(surface, realizations):
    """Return the parameters of whole surfaces and of contacts on them."""
    return {
        "surface": surface,
        "realizations": list(realizations),
        "seed": STUDY["seed"],
        "grid": FILES.whole_grid,
        "scan": SCAN_GRID,
        "has_features": surface in FILES.featured,
        "contact": CONTACT,
    }
