# The surfaces of the study and their scans, and what stands in the paths of intermediates.

import pandas as pd

from hardcontact.units import token

try:
    SCANS = studies.selected_scans(
        studies.surface_table(STUDY["surfaces"], read_schema("surfaces.schema.yaml")),
        STUDY["scans"],
    )
    if workflow.exec_mode == ExecMode.DEFAULT:
        studies.check(STUDY, SCANS, pd.read_csv("resources/paper/pull_off.csv").surface.unique())
except ValueError as error:
    sys.exit(f"error: {error}")  # one clear line, before any job starts

STORE = STUDY["store"]
FOLDERS.append(STORE)
SPHERE = STUDY["sphere"]["surface"]
SURFACES = list(SCANS.surface.unique())
SUBSTRATES = [surface for surface in SURFACES if surface != SPHERE]
LABELS = dict(zip(SCANS.surface, SCANS.label))
BASIS = dict(zip(SCANS.surface, SCANS.source))
REALIZATIONS = range(1, STUDY["scales"]["realizations"] + 1)

# What people sweep stands in the path.
RADIUS = f"R{token(config['sphere']['radius'], 'um')}"
LOAD = (
    f"H{token(config['contact']['hardness'], 'GPa')}-F{token(config['contact']['preload'], 'uN')}"
)
RANGE = f"rho{token(config['scales']['range'], 'nm')}"


# What substitutes can be made with instead, for robustness; uncd.laplacian is a UNCD so made.
OTHER_CURVATURE = {"half_laplacian": "laplacian", "laplacian": "half_laplacian"}[
    STUDY["topography"]["curvature"]
]
CHOICES = [OTHER_CURVATURE] + [f"skewness-{value:g}" for value in STUDY["robustness"]["skewness"]]


def plain(surface):
    """The surface itself, of a surface made otherwise."""
    return surface.partition(".")[0]


def scans_of(surface):
    return SCANS.scan[SCANS.surface == plain(surface)].tolist()


def row_of(surface, scan):
    return SCANS[(SCANS.surface == plain(surface)) & (SCANS.scan == int(scan))].iloc[0]


def shape_of(surface):
    """What a surface is before its roughness: flat, or the sphere."""
    return f"sphere-{RADIUS}" if surface == SPHERE else "flat"


def one_of(names):
    """A wildcard constraint; one that nothing meets where there are no names."""
    return "|".join(map(re.escape, names)) or "none(?!)"


def cutoff_tokens(side):
    return [token(cutoff, "nm") for cutoff in config["scales"][side]["cutoffs"]]


# What is computed for one scan of a substrate and one of the sphere.
PAIR = "{radius}/{load}/{surface}/scan-{scan}/sphere-scan-{sphere_scan}"


def pairs_of(surfaces):
    return [
        (surface, scan, sphere_scan)
        for surface in surfaces
        for scan in scans_of(surface)
        for sphere_scan in scans_of(SPHERE)
    ]


def pair_file(kind, surface, scan, sphere_scan):
    path = PAIR.format(
        radius=RADIUS, load=LOAD, surface=surface, scan=scan, sphere_scan=sphere_scan
    )
    return f"{STORE}/{kind}/{path}.nc"


wildcard_constraints:
    surface=rf"(?:{one_of(SURFACES)})(?:\.(?:{one_of(CHOICES)}))?",
    scan=r"\d+",
    sphere_scan=r"\d+",
    realization=r"\d+",
    side="small|large",
    shape=r"flat|sphere-R[0-9.e+-]+um",
    cutoff=r"none|[0-9.e+-]+nm",
    load=r"H[0-9.e+-]+GPa-F[0-9.e+-]+uN",
    radius=r"R[0-9.e+-]+um",
    range=r"rho[0-9.e+-]+nm",
