"""`hardcontact verify`: the check of the files of a finished study, wherever they are kept."""

import os
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

from hardcontact.base.verification import check
from hardcontact.own.command_line import CommandLine


def verify_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed command line, without the command; a wrong one ends the program."""
    description = "Name the files of a finished study that do not match their records."
    parser = CommandLine("hardcontact verify", description)
    parser.add_argument("folder", metavar="FOLDER", help="results of a study, or its name")
    return parser.parse_args(arguments)


def verify(arguments: Namespace) -> tuple[str, int]:
    """Return what does not match, in words, and the exit code; nothing is written.

    Raises ValueError, with one line, if the folder has no files of a study.
    """
    named = Path("results", arguments.folder)
    folder = (named if named.is_dir() else Path(arguments.folder)).resolve()
    if not folder.is_dir() or len(folder.parts) < 4:
        raise ValueError(f"{arguments.folder}: expected the results of a study, found none")
    # Records name files from the folder that has `results`.
    os.chdir(folder.parents[1])
    faults, summary = check(folder.relative_to(folder.parents[1]))
    return "\n".join([*faults, *summary]), 1 if faults else 0
