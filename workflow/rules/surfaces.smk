# The surfaces of the study, and the lists of their files.
#
# Names that the rules of several files use, besides those of common.smk:
#   SELECTION          the surfaces of the table, with their labels, scans and source files
#   LABELS_AND_SOURCES the parameters `labels` and `source`: the label of each surface, and whether it was
#                      measured or is a substitute
#   PLAN               what follows from keys and table together: scans, bodies and positions of contacts
#   STORE              the path of each kind of intermediate, with wildcards in braces
#   FILES              the paths of the files of a surface: `FILES.path` fills in the wildcards
#   SETTINGS           the settings of each kind of intermediate: all that its rule takes from STUDY. Their
#                      digest is in its path; a comment beside them names them. Most rules of final files
#                      take single keys of STUDY instead
#   CHUNKS             what one job computes together: some masters, whole surfaces or scans of a pool.
#                      FILES.paths(STORE.master_forces, CHUNKS.master_forces("edges")), for example, fills
#                      the pattern of forces with the fields of each chunk of the purpose `edges`
#   CONTACT_ARGUMENTS  the arguments of class Contact that are keys: hardness, preload, window,
#                      contacts_per_row and radius, without range and work of adhesion
#   DESCRIPTION_INPUTS the inputs `description` and `tables`: the description of a substitute, and the tables
#                      that it names
#   SUBSTITUTE_INPUTS  the input `substitute`: the files from which other random surfaces like a substitute
#                      are made
#   SPHERE_SCAN        the scan of the sphere that touches scans with changed or replaced octaves; none if
#                      the sphere is smooth, or if its roughness was added to that of the substrates

from hardcontact.config.configuration import contact_arguments
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.chunks import Chunks
from hardcontact.files.paths import wildcard_constraints as constraints
from hardcontact.files.paths import SurfaceFiles
from hardcontact.records.code import write_pins
from hardcontact.run import preparation

SELECTION = preparation.checked_selection(workflow, STUDY)
write_pins()  # Write the versions of packages only now: a run that is refused writes nothing.
LABELS_AND_SOURCES = {"labels": SELECTION.labels, "source": SELECTION.sources}
PLAN = StudyPlan(STUDY, SELECTION)
FILES = SurfaceFiles(PLAN)
STORE = FILES.patterns
SETTINGS = STORE.settings
CHUNKS = Chunks(FILES)
CONTACT_ARGUMENTS = contact_arguments(STUDY)
DESCRIPTION_INPUTS = {
    "description": lambda w: SELECTION.description_path(w.surface),
    "tables": lambda w: SELECTION.tables(w.surface),
}
SUBSTITUTE_INPUTS = {
    "substitute": lambda w: [
        FILES.spectrum_path(w.surface),
        PUBLISHED_TABLES["published_table1"],
        PUBLISHED_TABLES["published_constants"],
    ],
}
SPHERE_SCAN = (
    FILES.first_sphere_scan_path
    if SELECTION.contact_scan_numbers(SELECTION.sphere_surface) and not PLAN.combined_surfaces
    else []
)


wildcard_constraints:
    **constraints(SELECTION.surfaces, STORE.purposes),
