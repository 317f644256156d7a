"""The command line of `hardcontact new`, and checks of the name of a study."""

import os
from argparse import Namespace
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path

from hardcontact.commands.options import add_shared_options
from hardcontact.commands.parser import CommandLine
from hardcontact.commands.scan_files import label_faults
from hardcontact.config.key_types import MAX_NAME_LENGTH, study_name
from hardcontact.config.keys import QUICK_SUFFIX
from hardcontact.records.code import ROOT

#: Names that a study cannot have: the project's own files or results have them.
RESERVED_NAMES = ("config", "paper", "quick", "store", "surfaces")
USAGE = Path(__file__).with_name("new_help.txt").read_text("utf-8")


def new_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed command line, with the command; a wrong one ends the program.

    It also serves `hardcontact --help` and unknown commands.
    """
    parser = CommandLine("hardcontact", USAGE)
    parser.add_argument("--version", action="version", version=version("hardcontact"))
    parser.add_argument(
        "command", choices=["new", "predict", "verify", "compare"],
        metavar="{new,predict,verify,compare}",
        help="new: make a study of your surfaces; predict: a force from a spectrum, see "
        "hardcontact predict --help; verify: check the files of a finished study; compare: the "
        "numbers of two studies",
    )  # fmt: skip
    parser.add_argument(
        "name", metavar="NAME", help="name of the study; results go to results/NAME/"
    )
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
    if arguments.files:
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
    elif _is_locked(name):
        yield (
            f"--overwrite: expected no run of {name}, found its lock: wait for its end, or remove "
            "what a killed run left with `snakemake --unlock`"
        )


def _is_locked(study: str) -> bool:
    """Return whether a run of Snakemake writes results of a study, at either effort."""
    results = (f"results/{study}/", f"results/{study}{QUICK_SUFFIX}/")
    return any(
        line.startswith(results)
        for path in (ROOT / ".snakemake/locks").glob("*.lock")
        for line in path.read_text("utf-8").splitlines()
    )
