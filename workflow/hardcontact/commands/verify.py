"""The command `hardcontact verify`: it compares files of a finished study with their records."""

import os
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path

from hardcontact.commands.options import CommandLine
from hardcontact.config.configuration import apply_effort, key_values, merge
from hardcontact.config.faults import shorten
from hardcontact.config.keys import QUICK_SUFFIX
from hardcontact.config.user_files import read_yaml
from hardcontact.records.code import ROOT
from hardcontact.records.origin import canonical_json, read_record
from hardcontact.records.verification import verify_study


def verify_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed command line, without the command; a wrong one ends the program."""
    description = "Name the files of a finished study that do not match their records."
    parser = CommandLine("hardcontact verify", description)
    parser.add_argument("folder", metavar="FOLDER", help="results of a study, or its name")
    return parser.parse_args(arguments)


def verify(arguments: Namespace) -> tuple[str, int]:
    """Return the files that do not match their records, in words, and the exit code."""
    results_folder = Path("results", arguments.folder)
    folder = (results_folder if results_folder.is_dir() else Path(arguments.folder)).resolve()
    if not folder.is_dir() or len(folder.parts) < 4:
        raise ValueError(f"{arguments.folder}: expected the results of a study, found none")
    # Records name files from the folder that has `results`.
    os.chdir(folder.parents[1])
    results = folder.relative_to(folder.parents[1])
    faults, summary = verify_study(results)
    return "\n".join([*faults, *_changed_keys(results), *summary]), 1 if faults else 0


def _changed_keys(results: Path) -> Iterator[str]:
    """Yield a line for each key that has another value now in this repository's overlay.

    The overlay of a study has its name; values of the command line are in no file.
    """
    record = read_record(results / "configuration.yaml")
    if record is None:
        return
    recorded = record.parameters
    current = read_yaml("config/config.yaml")
    if recorded["study"] != current["study"]:
        overlay = f"config/{recorded['study'].removesuffix(QUICK_SUFFIX)}.yaml"
        if not (ROOT / overlay).is_file():
            yield f"{results}: parameters were not compared, as there is no {overlay} here"
            return
        current = merge(current, read_yaml(overlay))
    current = key_values(apply_effort(current | {"effort": recorded["effort"]}))
    for key, value in key_values(recorded).items():
        if canonical_json(value) != canonical_json(current.get(key)):
            present_value = shorten(current[key]) if key in current else "no value"
            yield f"{results} was made with {key} {shorten(value)}, here {present_value}"
