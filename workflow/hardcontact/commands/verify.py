"""The command `hardcontact verify`: it compares files of a finished study with their records."""

import os
from argparse import Namespace
from collections.abc import Sequence

from hardcontact.commands.options import CommandLine
from hardcontact.commands.outputs import results_folder
from hardcontact.records.verification import verify_study


def verify_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed command line, without the command; a wrong one ends the program."""
    description = "Name the files of a finished study that do not match their records."
    parser = CommandLine("hardcontact verify", description)
    parser.add_argument("folder", metavar="FOLDER", help="results of a study, or its name")
    return parser.parse_args(arguments)


def verify(arguments: Namespace) -> tuple[str, int]:
    """Return the files that do not match their records, in words, and the exit code."""
    folder = results_folder(arguments.folder).resolve()
    # A study is at least /FOLDER/results/STUDY, which has four parts.
    if not folder.is_dir() or len(folder.parts) < 4:
        raise ValueError(f"{arguments.folder}: expected the results of a study, found none")
    # Records name files from the folder that has `results`.
    os.chdir(folder.parents[1])
    results = folder.relative_to(folder.parents[1])
    faults, summary = verify_study(results)
    return "\n".join([*faults, *summary]), 1 if faults else 0
