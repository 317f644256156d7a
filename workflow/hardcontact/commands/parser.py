"""The parser of the words of a command."""

from argparse import ArgumentParser, RawDescriptionHelpFormatter
from typing import NoReturn

from hardcontact.config.faults import spelling_question


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
        question = self._spelling_question(message)
        self.exit(2, f"error: {message}{question}; {self.prog} --help lists all options\n")

    def _spelling_question(self, message: str) -> str:
        """Return a question if a message names a word that resembles a known one, or no text."""
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
