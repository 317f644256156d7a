"""The parser of all commands: a faulty command line is refused in one line."""

import difflib
import re
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from typing import NoReturn

from hardcontact.config.faults import SIMILARITY


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
            known = [name for name in self._option_string_actions if name.startswith("--")]
        similar = difflib.get_close_matches(choice, known, 1, SIMILARITY)
        return f" (did you mean {similar[0]}?)" if similar else ""
