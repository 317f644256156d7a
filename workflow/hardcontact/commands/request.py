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
        paths = (f"config/{name}.yaml", f"config/{name}.tsv", *results)
        if existing := [path for path in paths if os.path.lexists(ROOT / path)]:
            yield (
                f"NAME: expected a new name, found {', '.join(existing)}: take another name, or "
                "add --overwrite"
            )


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


def list_scan_files(arguments: Namespace, radius: float) -> list[ScanFile]:
    """Return the files of all surfaces, the sphere's last; `radius` (nm) is that of the sphere."""
    return [
        ScanFile(
            surface=surface_id(label),
            label=label,
            path=path,
            table_path=path_from_root(path),
            # Files are compared, because by mistake a surface may have the label of the sphere.
            sphere_radius=radius if files is arguments.sphere else None,
            is_in_folder=path != file,
        )
        for label, files in _labelled_files(arguments)
        for file in files
        for path in _files_in(file)
    ]


def file_faults(arguments: Namespace) -> Iterator[str]:
    """Yield a line for each fault of the labels, files and folders of the command line."""
    if not (arguments.files or arguments.surface):
        yield "FILE: expected files of scans, found none"
    for label, *files in arguments.surface:
        yield from label_faults("--surface", label)
        if not files:
            yield f"--surface {label}: expected files of scans, found none"
    labels: dict[str, str] = {}
    counts = Counter[str]()
    for label, files in _labelled_files(arguments):
        surface = surface_id(label)
        if surface in labels:
            yield (
                f"labels {labels[surface]} and {label}: expected different ids, found {surface} "
                "for both: take labels that differ in letters a-z or digits"
            )
        labels.setdefault(surface, label)
        for file in files:
            paths = _files_in(file)
            if not paths:
                yield f"{file}: expected a folder with files of scans, found none"
            counts.update(path_from_root(path) for path in paths)
    for path, count in counts.items():
        if count > 1:
            yield f"{path}: expected each file once, found it {count} times"


def _labelled_files(arguments: Namespace) -> Iterator[tuple[str, list[str]]]:
    """Yield the label of each surface with its files and folders, the sphere last."""
    if arguments.files:
        yield arguments.name, arguments.files
    for label, *files in arguments.surface:
        yield label, files
    if arguments.sphere:
        yield SPHERE, arguments.sphere


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
