"""The program `hardcontact`, and what its commands share: their parser and their output.

No command replaces an input; it replaces other files only with --overwrite.
"""

import os
import re
import sys
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NoReturn

from hardcontact.base.dataset import atomic_file
from hardcontact.base.units import FACTORS
from hardcontact.config.faults import raise_faults, spelling_question


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
        for line in dict.fromkeys(str(error).splitlines()):
            print(f"error: {line}", file=sys.stderr)
        code = 1
    except KeyboardInterrupt:
        print("Stopped before anything was written.", file=sys.stderr)
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
        case _:
            from hardcontact.commands.new import new_study
            from hardcontact.commands.request import new_arguments

            return new_study(new_arguments(words)), 0


def join_units(words: Sequence[str]) -> list[str]:
    """Return the words of a command line, each number and the unit after it as one word."""
    arguments = list[str]()
    for word in words:
        is_unit = any(re.sub(r"\^2|²", "2", word) in units for units in FACTORS.values())
        if is_unit and arguments and re.fullmatch(r"(--\w+=)?[0-9.]+(e-?[0-9]+)?", arguments[-1]):
            arguments[-1] += word
        else:
            arguments.append(word)
    return arguments


class CommandLine(ArgumentParser):
    """A parser without short options, which suggests the right word for a wrong one."""

    def __init__(self, command: str, description: str) -> None:
        """Take the command, and the text with which its help begins."""
        super().__init__(
            command, description=description, formatter_class=RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )  # fmt: skip

    def error(self, message: str) -> NoReturn:
        """End the program with one line, which asks whether another word is meant."""
        line = f"error: {message}{self._question(message)}; {self.prog} --help lists all options"
        self.exit(2, f"{line}\n")

    def _question(self, message: str) -> str:
        """Return a question if a message names an unknown word that resembles a known one."""
        if "invalid choice: " in message:
            choice = message.partition("invalid choice: '")[2].partition("'")[0]
            known_words = [word for action in self._actions for word in action.choices or ()]
        else:
            unknown = message.partition("unrecognized arguments: ")[2].partition(" ")[0]
            choice = unknown.partition("=")[0]
            if choice == "--diameter":
                return " (did you mean --radius, with half of it?)"
            known_words = [name for name in self._option_string_actions if name.startswith("--")]
        return spelling_question(choice, known_words)


def output_faults(
    outputs: Mapping[str, str | None], inputs: Mapping[str, str], overwrite: bool
) -> Iterator[str]:
    """Yield a line for each output that cannot be written, or would replace a file.

    `outputs` are paths by option: None if not asked for, - for the terminal. `inputs` are words
    such as "that of the surface", by path.
    """
    reserved = {
        os.path.realpath(path): f"another file than {words}" for path, words in inputs.items()
    }
    for option, path in outputs.items():
        if path is None:
            continue
        real_path = path if path == "-" else os.path.realpath(path)
        if real_path in reserved:
            yield f"--{option}: expected {reserved[real_path]}, found {path}"
        elif path != "-" and (not Path(real_path).parent.is_dir() or Path(real_path).is_dir()):
            yield f"--{option}: expected a file in a folder that exists, found {path}"
        elif Path(real_path).is_file() and not overwrite:
            yield (
                f"--{option}: expected a new file, found {path}: take another name, or add "
                "--overwrite"
            )
        reserved[real_path] = f"another file than that of --{option}"


def align_cells(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the rows as lines, with cells in columns; the last cell of a row may be longer."""
    columns = max(map(len, rows))
    padded = [[*row, *[""] * (columns - len(row))] for row in rows]
    widths = [
        max((len(row[column]) for row in rows if len(row) > column + 1), default=0)
        for column in range(columns)
    ]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in padded]


def write_output(path: str, text: str) -> None:
    """Write a file completely; pipes and devices take the text as it comes."""
    if Path(path).exists() and not Path(path).is_file():
        Path(path).write_text(text, "utf-8")
        return
    with atomic_file(os.path.realpath(path)) as temporary:
        Path(temporary).write_text(text, "utf-8")
