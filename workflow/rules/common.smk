# The study's configuration, its paths, and the code that each script really uses.

import ast
import re

import pandas as pd
from snakemake.settings.types import ExecMode

from hardcontact import study as studies
from hardcontact.dataset import canonical
from hardcontact.units import token


def read_schema(name):
    return yaml.safe_load(Path(workflow.basedir, "workflow/schemas", name).read_text())


try:
    STUDY = studies.configuration(config, read_schema("config.schema.yaml"))
    SCANS = studies.selected_scans(
        studies.surface_table(STUDY["surfaces"], read_schema("surfaces.schema.yaml")),
        STUDY["scans"],
    )
    if workflow.exec_mode == ExecMode.DEFAULT:
        studies.check(STUDY, SCANS, pd.read_csv("resources/paper/pull_off.csv").surface.unique())
except ValueError as error:
    sys.exit(f"error: {error}")  # one clear line, before any job starts

STORE = STUDY["store"]
RESULTS = f"results/{STUDY['study']}"
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


def code(script):
    """A script, the library's modules that it imports, directly or not, and the pinned packages.

    As inputs they are compared by content; of a script alone Snakemake would watch the time.
    """
    folder = Path(workflow.basedir, "workflow/hardcontact")
    pending = [Path(workflow.basedir, "workflow/scripts", script)]
    found = set(pending)
    while pending:
        for module in imported(ast.parse(pending.pop().read_text())):
            path = folder.joinpath(*module.split(".")[1:])
            path = path.with_suffix(".py") if not path.is_dir() else path / "__init__.py"
            if path.is_file() and path not in found:
                found.add(path)
                pending.append(path)
    return sorted(os.path.relpath(path) for path in found) + ["environment.txt"]


def imported(tree):
    """Names under hardcontact that a syntax tree imports."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("hardcontact"):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (a.name for a in node.names if a.name.startswith("hardcontact"))


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
