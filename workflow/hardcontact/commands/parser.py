"""The parser of all commands: a faulty command line is refused in one line."""

import re
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Sequence
from typing import NoReturn

from hardcontact.base.units import FACTORS
from hardcontact.config.faults import spelling_question


def join_units(words: Sequence[str]) -> list[str]:
    """Return the words of a command line; a number and a unit after it become one word."""
    joined = list[str]()
    for word in words:
        is_unit = any(re.sub(r"\^2|²", "2", word) in units for units in FACTORS.values())
        if is_unit and joined and re.fullmatch(r"(--\w+=)?[0-9.]+(e-?[0-9]+)?", joined[-1]):
            joined[-1] += word
        else:
            joined.append(word)
    return joined


class CommandLine(ArgumentParser):
    """A parser whose options have no short forms, and which suggests one for a wrong option."""

    def __init__(self, command: str, description: str) -> None:
        """Take the command, and the text with which its help begins."""
        super().__init__(
            command, description=description, formatter_class=RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )  # fmt: skip

    def error(self, message: str) -> NoReturn:
        """End the program with one line, which names the option that an unknown one resembles."""
        line = f"error: {message}{self._question(message)}; {self.prog} --help lists all options"
        self.exit(2, f"{line}\n")

    def _question(self, message: str) -> str:
        """Return a question if a message names an unknown word that resembles a known one."""
        if "invalid choice: " in message:
            choice, *known = re.findall(r"'([^']+)'", message)
        else:
            unknown = message.partition("unrecognized arguments: ")[2].partition(" ")[0]
            choice = unknown.partition("=")[0]
            if choice == "--diameter":
                return " (did you mean --radius, with half of it?)"
            known = [name for name in self._option_string_actions if name.startswith("--")]
        return spelling_question(choice, known)
