# The surfaces of the study, and the lists of their files.
#
# Names that several files of rules use:
#   SELECTION          the surfaces of the table, with their labels, scans and source files
#   SPHERE             the name of the sphere's surface
#   NAMED_SURFACES     the label of each surface, and whether it was measured or is a substitute
#   FILES              the files of each surface: spectra, scans, pairs of scans
#   CHUNKS             what one job computes together: scans of pools, masters, whole surfaces
#   SCAN_GRID          pixels and size (nm) of a substitute scan, and the pixels of the random surface
#                      from which it is cut
#   DESCRIPTION_INPUTS the description of a substitute, and the tables that it names
#   SUBSTITUTE_INPUTS  from which random surfaces like a substitute are made

from hardcontact.config.grids import realization_pixels
from hardcontact.files.chunks import Chunks
from hardcontact.files.patterns import any_name_pattern
from hardcontact.files.patterns import wildcard_constraints as constraints
from hardcontact.files.surface_files import SurfaceFiles

SELECTION = start.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
NAMED_SURFACES = {"labels": SELECTION.labels, "basis": SELECTION.basis}
FILES = SurfaceFiles(STUDY, SELECTION, PATTERNS)
CHUNKS = Chunks(FILES)
SCAN_GRID = {
    **{key: STUDY["scan"][key] for key in ("pixels", "size")},
    "realization_pixels": realization_pixels(STUDY["scan"]["pixels"]),
}
DESCRIPTION_INPUTS = {
    "description": lambda w: SELECTION.description(w.surface),
    "tables": lambda w: SELECTION.tables(w.surface),
}
SUBSTITUTE_INPUTS = {
    "spectrum": lambda w: FILES.spectrum(w.surface),
    "published_table1": PUBLISHED_TABLES["published_table1"],
    "published_constants": PUBLISHED_TABLES["published_constants"],
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
