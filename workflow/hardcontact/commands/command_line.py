"""The program `hardcontact`: it runs one command, and prints its report or its faults."""

import os
import re
import sys
from collections.abc import Sequence

from hardcontact.base.units import FACTORS
from hardcontact.config.faults import raise_faults


def main() -> int:
    """Run the command of the command line, and print its report; return the exit code."""
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
            from hardcontact.commands.verify import verify, verify_arguments

            return verify(verify_arguments(words[1:]))
        case ["compare"]:
            from hardcontact.commands.compare import compare, compare_arguments

            return compare(compare_arguments(words[1:])), 0
        case _:  # `new`; its parser also answers --help, --version and an unknown command.
            from hardcontact.commands.new import new_study
            from hardcontact.commands.request import new_arguments

            return new_study(new_arguments(words)), 0


def join_units(words: Sequence[str]) -> list[str]:
    """Return the words of a command line, each number and the unit after it as one word."""
    number = r"(--\w+=)?[0-9.]+([eE][+-]?[0-9]+)?"
    arguments = list[str]()
    for word in words:
        is_unit = any(re.sub(r"\^2|²", "2", word) in units for units in FACTORS.values())
        if is_unit and arguments and re.fullmatch(number, arguments[-1]):
            arguments[-1] += word
        else:
            arguments.append(word)
    return arguments
