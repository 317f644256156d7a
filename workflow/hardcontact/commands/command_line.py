"""The program `hardcontact`: it runs one command, and prints its report or its faults."""

import os
import re
import sys
from collections.abc import Sequence

from hardcontact.base.units import FACTORS
from hardcontact.config.faults import raise_faults


def main() -> int:
    """Run the command, print its report, and return the exit code."""
    words = join_units(sys.argv[1:])
    try:
        # A terminal would obey control characters, and tables are written in UTF-8.
        raise_faults(
            f"{word!r}: expected printable characters in UTF-8, found others"
            for word in words
            if not word.isprintable()
        )
        text, code = _run(words)
        print(text, flush=True)
    except BrokenPipeError:  # The reader of the output has ended, such as `head`.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 0
    except ValueError as error:
        for line in str(error).splitlines():
            print(f"error: {line}", file=sys.stderr)
        code = 1
    except KeyboardInterrupt:
        print("Stopped.", file=sys.stderr)
        code = 130
    return code


def _run(words: Sequence[str]) -> tuple[str, int]:
    """Return the report and the exit code of the command with which the words begin."""
    match words[:1]:
        case ["predict"]:
            from hardcontact.commands.predict import predict, predict_arguments

            return predict(predict_arguments(words[1:])), 0
        case ["verify"]:
            return _verify(words[1:])
        case ["compare"]:
            from hardcontact.commands.compare import compare, compare_arguments

            return compare(compare_arguments(words[1:])), 0
        case _:  # `new`; its parser also answers --help, --version and an unknown command.
            from hardcontact.commands.new import new_study
            from hardcontact.commands.request import new_arguments

            return new_study(new_arguments(words)), 0


def _verify(words: Sequence[str]) -> tuple[str, int]:
    """Return the report on files that do not match their records, and the exit code."""
    from hardcontact.commands.options import CommandLine
    from hardcontact.commands.outputs import results_folder
    from hardcontact.records.verification import verify_study

    description = "Name the files of a finished study that do not match their records."
    parser = CommandLine("hardcontact verify", description)
    parser.add_argument("folder", metavar="FOLDER", help="results of a study, or its name")
    arguments = parser.parse_args(words)
    folder = results_folder(arguments.folder).resolve()
    # A study is at least /FOLDER/results/STUDY, which has four parts.
    if not folder.is_dir() or len(folder.parts) < 4:
        raise ValueError(f"{arguments.folder}: expected the results of a study, found none")
    # Paths in records begin at the folder that has `results`.
    os.chdir(folder.parents[1])
    faults, summary = verify_study(folder.relative_to(folder.parents[1]))
    return "\n".join([*faults, *summary]), 1 if faults else 0


def join_units(words: Sequence[str]) -> list[str]:
    """Return the words of a command line, each number and the unit after it as one word."""
    number_pattern = r"(--\w+=)?[0-9.]+([eE][+-]?[0-9]+)?"
    joined_words = list[str]()
    for word in words:
        is_unit = any(re.sub(r"\^2|²", "2", word) in units for units in FACTORS.values())
        if is_unit and joined_words and re.fullmatch(number_pattern, joined_words[-1]):
            joined_words[-1] += word
        else:
            joined_words.append(word)
    return joined_words
