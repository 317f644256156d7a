# The surfaces of the study, and the lists of their files.
#
# Names that several files of rules use:
#   SELECTION          the surfaces of the table, with their labels, scans and source files
#   SPHERE             the name of the sphere's surface
#   NAMED_SURFACES     the label of each surface, and whether it was measured or is a substitute
#   FILES              the files of each surface: spectra, scans, pairs of scans
#   CHUNKS             what one job computes together: scans of pools, masters, whole surfaces
#   CONTACT            the arguments of class Contact: the keys of `contact`, the sphere's radius
#   CONTACT_AT_RANGE   these, and the range of adhesion (nm)
#   SCAN_GRID          pixels and size (nm) of a substitute scan, and the pixels of the random surface
#                      from which it is cut
#   DESCRIPTION_INPUTS the description of a substitute, and the tables that it names
#   SUBSTITUTE_INPUTS  from which random surfaces like a substitute are made
# Functions are here, because the linter of Snakemake wants them apart from rules.

from hardcontact.config.grids import master_megabytes, random_surface_pixels
from hardcontact.files.chunks import Chunks
from hardcontact.files.master_purposes import filter_settings
from hardcontact.files.patterns import any_name_pattern
from hardcontact.files.patterns import wildcard_constraints as constraints
from hardcontact.files.surface_files import SurfaceFiles

SELECTION = start.checked_selection(workflow, STUDY)
SPHERE = SELECTION.sphere
NAMED_SURFACES = {"labels": SELECTION.labels, "basis": SELECTION.basis}
FILES = SurfaceFiles(STUDY, SELECTION, PATTERNS)
CHUNKS = Chunks(FILES)
CONTACT = STUDY["contact"] | {"radius": STUDY["sphere"]["radius"]}
CONTACT_AT_RANGE = CONTACT | {"rho": STUDY["adhesion"]["range"]}
SCAN_GRID = {
    **{key: STUDY["scan"][key] for key in ("pixels", "size")},
    "surface_pixels": random_surface_pixels(STUDY["scan"]["pixels"]),
}
DESCRIPTION_INPUTS = {
    "description": lambda w: SELECTION.description(w.surface),
    "tables": lambda w: SELECTION.tables(w.surface),
}
SUBSTITUTE_INPUTS = {
    "spectrum": lambda w: FILES.spectrum_path(w.surface),
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


def whole_surface_parameters(surface, realizations):
    """Return the parameters of whole surfaces and of contacts on them."""
    return {
        "surface": surface,
        "realizations": list(realizations),
        "seed": STUDY["seed"],
        "grid": FILES.whole_surface_grid,
        "scan_grid": SCAN_GRID,
        "has_features": surface in FILES.featured_surfaces,
        "contact": CONTACT_AT_RANGE,
    }


def chunk_parameters(wildcards):
    """Return the parameters of the surfaces of a pool or of samples, and of contacts on them."""
    return {
        "surface": wildcards.surface,
        "first": int(wildcards.first),
        "last": int(wildcards.last),
        "scan_count": len(SELECTION.scans(wildcards.surface)),
        "scan_grid": SCAN_GRID,
        "contact": CONTACT | {"contacts_per_row": STUDY["sets"]["contacts_per_row"]},
        "ranges": RANGES,
        "seed": STUDY["seed"],
    }


def filter_megabytes(wildcards):
    """Return the memory of a job that filters masters, by the larger of its two masters."""
    sides = filter_settings(STUDY, wildcards.purpose)["sides"]
    return master_megabytes(max(side["pixels"] for side in sides.values()), 3000)
