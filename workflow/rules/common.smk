# What every rule needs: the library, the configuration, the code that a script really uses.

import ast
import os
import re
import sys
from pathlib import Path

import yaml
from snakemake.settings.types import ExecMode

# The library is found here and, through the environment, by every job.
WORKFLOW = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parent
sys.path.insert(0, str(WORKFLOW))
os.environ["PYTHONPATH"] = os.pathsep.join(
    filter(None, [sys.path[0], os.environ.get("PYTHONPATH")])
)

from hardcontact import folders
from hardcontact import study as studies
from hardcontact.dataset import canonical


def read_schema(name):
    return yaml.safe_load((WORKFLOW / "schemas" / name).read_text())


try:
    if workflow.exec_mode == ExecMode.DEFAULT:
        for path in workflow.configfiles:
            studies.refuse_repeated_keys(os.path.relpath(path))
    STUDY = studies.configuration(config, read_schema("config.schema.yaml"))
except ValueError as error:
    sys.exit(f"error: {error}")  # one clear line, before any job starts

try:
    Path(".snakemake").mkdir(exist_ok=True)  # Snakemake's own attempt ends in a traceback
except OSError as error:
    sys.exit(f"error: .snakemake: expected a folder to write to, found: {error.strerror}")

RESULTS = f"results/{STUDY['study']}"


def code(script):
    """A script, the library's modules that it imports, directly or not, and the pinned packages.

    As inputs they are compared by content; of a script alone Snakemake would watch the time.
    """
    folder = WORKFLOW / "hardcontact"
    pending = [WORKFLOW / "scripts" / script]
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


# The folders that are written to, and what keeps other runs out of them.
FOLDERS, HELD = [RESULTS], []


onstart:
    try:
        HELD.extend(folders.hold(folder) for folder in FOLDERS)
    except ValueError as error:
        sys.exit(f"error: {error}")
    # To keep to 100 jobs a second Snakemake 9.27 looks for work again a second after each time it
    # did, for ever: after a thousand jobs a thousand times a second. No limit is needed here.
    workflow.scheduler.job_rate_limiter = None


onerror:
    # The names of what failed scroll away where the rest goes on.
    text = "".join(Path(path).read_text() for path in log)
    failed = re.findall(r"^    log: (\S+) \(check log", text, re.M)
    for path in dict.fromkeys(failed):
        if Path(path).is_file():  # a job that was stopped early has none
            print(f"failed: see {path}", file=sys.stderr)
