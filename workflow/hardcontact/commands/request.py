"""What the user asks of `hardcontact new`: its command line, and the names and files in it."""

import os
import re
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from hardcontact.commands.options import CommandLine, add_shared_options
from hardcontact.config.key_types import MAX_NAME_LENGTH, study_name
from hardcontact.config.keys import QUICK_SUFFIX
from hardcontact.config.selected_surfaces import LABEL, RESERVED_IDS
from hardcontact.records.code import ROOT

#: Names that a study cannot have: the project's own files or results have them.
RESERVED_NAMES = ("config", "paper", "quick", "store", "surfaces")
USAGE = Path(__file__).with_name("new_help.txt").read_text("utf-8")
#: Id and label of the sphere's surface.
SPHERE = "sphere"


def new_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed arguments of `hardcontact new`.

    The parser also answers --help, --version and unknown commands; these end the program.
    """
    parser = CommandLine("hardcontact", USAGE)
    parser.add_argument("--version", action="version", version=version("hardcontact"))
    parser.add_argument(
        "command", choices=["new", "predict", "verify", "compare"],
        metavar="{new,predict,verify,compare}",
        help="new: make a study of your surfaces; predict: the force on a scan, or from a "
        "spectrum, see hardcontact predict --help; verify: check the files of a finished study; "
        "compare: the numbers of two studies",
    )  # fmt: skip
    parser.add_argument("name", metavar="NAME", help="name of the study, made in results/NAME/")
    parser.add_argument(
        "files", metavar="FILE", nargs="*",
        help="scans, line scans or containers of one surface, or folders of them",
    )  # fmt: skip
    parser.add_argument(
        "--surface", nargs="+", action="append", default=[], metavar=("LABEL", "FILE"),
        help="a label and the files of a surface; repeat it for each surface",
    )  # fmt: skip
    parser.add_argument(
        "--sphere", nargs="+", default=[], metavar="FILE",
        help="scans of the sphere where it touches (default: smooth)",
    )  # fmt: skip
    add_shared_options(parser)
    parser.add_argument(
        "--channel", default="", metavar="NAME",
        help="name or number of the channel to read, for all files that are not containers "
        "(default: the first channel of heights)",
    )  # fmt: skip
    parser.add_argument("--forces", metavar="CSV", help="own pull-off forces, with their units")
    parser.add_argument(
        "--overwrite", action="store_true",
        help="replace the files of a study of this name, and with the next run its results",
    )  # fmt: skip
    return parser.parse_intermixed_args(arguments)


def name_faults(arguments: Namespace) -> Iterator[str]:
    """Yield a line for each fault of the name of a study."""
    name = arguments.name
    # The suffix must fit behind the name, for the quick study.
    accepted_names = study_name(MAX_NAME_LENGTH - len(QUICK_SUFFIX))
    try:
        accepted_names.check(name)
    except ValueError:
        yield f"NAME: expected {accepted_names.expects}, no blanks, found {name!r}"
        return
    if arguments.files:  # The name is the label of their surface, too.
        yield from label_faults("NAME", name)
    if name.endswith(QUICK_SUFFIX):
        accepted = f"a name without the end {QUICK_SUFFIX}, which marks first answers"
        yield f"NAME: expected {accepted}, found {name}"
    elif name in RESERVED_NAMES:
        yield f"NAME: expected a name that the project does not use, found {name}"
    elif not arguments.overwrite:
        # Results of this name may come from other inputs.
        results = (f"results/{name}", f"results/{name}{QUICK_SUFFIX}")
        for file in (f"config/{name}.yaml", f"config/{name}.tsv", *results):
            if os.path.lexists(ROOT / file):
                yield f"{file}: expected none, found one: take another name, or add --overwrite"


class ScanFile(NamedTuple):
    """A file with scans of one surface."""

    surface: str  #: Id of the surface.
    label: str  #: Name of the surface in figures.
    path: str  #: Path from the working directory.
    table_path: str  #: Path from the top folder, for the table of surfaces.
    sphere_radius: float | None = None  #: In nm, for scans of the sphere alone.
    is_in_folder: bool = False  #: Whether the user named its folder, which may hold other files.


def label_faults(option: str, label: str) -> Iterator[str]:
    """Yield a line if a label is not valid in figures."""
    try:
        LABEL.check(label)
    except ValueError as error:
        yield f"{option}: label: {error}"


def list_scan_files(arguments: Namespace, radius: float) -> tuple[list[ScanFile], list[str]]:
    """Return the files of all surfaces, the sphere's last, and a line for each fault."""
    labelled_files = [(arguments.name, arguments.files)] if arguments.files else []
    labelled_files += [(label, files) for label, *files in arguments.surface]
    faults = [] if labelled_files else ["FILE: expected files of scans, found none"]
    for label, *files in arguments.surface:
        faults += label_faults("--surface", label)
        if not files:
            faults.append(f"--surface {label}: expected files of scans, found none")
    labelled_files += [(SPHERE, arguments.sphere)] if arguments.sphere else []
    scan_files: list[ScanFile] = []
    labels: dict[str, str] = {}
    for label, files in labelled_files:
        surface = surface_id(label)
        if surface in labels:
            faults.append(
                f"labels {labels[surface]} and {label}: expected different ids, found {surface} "
                "for both: take labels that differ in letters a-z or digits"
            )
        labels.setdefault(surface, label)
        # Files are compared, because by mistake a surface may have the label of the sphere.
        sphere_radius = radius if files is arguments.sphere else None
        for file in files:
            file_paths = _files_in(file)
            if not file_paths:
                faults.append(f"{file}: expected a folder with files of scans, found none")
            for path in file_paths:
                scan_file = ScanFile(surface, label, path, path_from_root(path), sphere_radius)
                scan_files.append(scan_file._replace(is_in_folder=path != file))
    counts = Counter(scan_file.table_path for scan_file in scan_files)
    faults += [
        f"{path}: expected each file once, found it {count} times"
        for path, count in counts.items()
        if count > 1
    ]
    return scan_files, faults


def _files_in(path: str) -> list[str]:
    """Return the files in a folder, without hidden ones; any other path alone."""
    if not Path(path).is_dir():
        return [path]
    return sorted(str(file) for file in Path(path).glob("[!.]*") if file.is_file())


def surface_id(label: str) -> str:
    """Return the id of a surface, as `SurfaceRow` accepts it, from its label."""
    name = re.sub(r"[^a-z0-9]+", "_", label.lower()).strip("_")
    if name in RESERVED_IDS or not re.match("[a-z]", name):
        name = f"surface_{name}".rstrip("_")
    return name[:40].rstrip("_")


def path_from_root(file: str) -> str:
    """Return a path relative to the top folder; an absolute path to elsewhere stays absolute."""
    absolute = os.path.abspath(file)
    if os.path.isabs(file) and not Path(absolute).is_relative_to(ROOT):
        return absolute
    return os.path.relpath(absolute, ROOT)
