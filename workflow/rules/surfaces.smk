# The surfaces of the study, and the lists of their files.
#
# Names that the rules of several files use:
#   SELECTION          the surfaces of the table, with their labels, scans and source files
#   SPHERE             the name of the sphere's surface
#   NAMED_SURFACES     the label of each surface, and whether it was measured or is a substitute
#   PLAN               which scans, bodies and positions contacts are made on, with their settings
#   FILES              the paths of each surface: spectra, scans, scans of both bodies in one
#   CHUNKS             what one job computes together: scans of pools, masters, whole surfaces
#   CONTACT            the arguments of class Contact: the keys of `contact`, the sphere's radius
#   CONTACT_AT_RANGE   these, and the range of adhesion (nm)
#   SCAN_GRID          pixels and size (nm) of a substitute scan, and the pixels of the random surface
#                      from which it is cut
#   DESCRIPTION_INPUTS the description of a substitute, and the tables that it names
#   SUBSTITUTE_INPUTS  from which random surfaces like a substitute are made
#   WHOLE_SURFACES     parameters of whole substitute surfaces, and of contacts on them
#   SPHERE_SCAN        the scan of the sphere; none if its roughness was added to that of substrates

from hardcontact.config.limits import random_surface_pixels
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.chunks import Chunks
from hardcontact.files.patterns import wildcard_constraints as constraints
from hardcontact.files.surface_files import SurfaceFiles
from hardcontact.run import study_inputs

SELECTION = study_inputs.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
NAMED_SURFACES = {"labels": SELECTION.labels, "source": SELECTION.sources}
PLAN = StudyPlan(STUDY, SELECTION)
FILES = SurfaceFiles(PLAN, PATTERNS)
CHUNKS = Chunks(FILES)
CONTACT = STUDY["contact"] | {"radius": STUDY["sphere"]["radius"]}
CONTACT_AT_RANGE = CONTACT | {"rho": STUDY["adhesion"]["range"]}
SCAN_GRID = {
    **{key: STUDY["substitutes"][key] for key in ("pixels", "size")},
    "surface_pixels": random_surface_pixels(STUDY["substitutes"]["pixels"]),
}
DESCRIPTION_INPUTS = {
    "description": lambda w: SELECTION.description(w.surface),
    "tables": lambda w: SELECTION.tables(w.surface),
}
SUBSTITUTE_INPUTS = {
    "substitute": lambda w: [
        FILES.spectrum_path(w.surface),
        PUBLISHED_TABLES["published_table1"],
        PUBLISHED_TABLES["published_constants"],
    ],
}
WHOLE_SURFACES = {
    "seed": STUDY["seed"],
    "grid": PLAN.whole_surface_grid,
    "scan_grid": SCAN_GRID,
    "contact": CONTACT_AT_RANGE,
}
SPHERE_SCAN = (
    FILES.first_sphere_path
    if SELECTION.contact_scans(SPHERE) and not PLAN.combined_surfaces
    else []
)


wildcard_constraints:
    **constraints(SELECTION.surfaces),
