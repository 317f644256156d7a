"""The parser of command lines, and the options that `new` and `predict` share."""

from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, NoReturn

from hardcontact.config.arguments import unit_question
from hardcontact.config.configuration import CONTACT_QUANTITIES, key_field, quantity_type
from hardcontact.config.faults import collect_faults, spelling_question
from hardcontact.config.key_types import UNIT
from hardcontact.config.keys import NONE
from hardcontact.config.selected_surfaces import TIP_RADIUS
from hardcontact.contact.contact import Contact
from hardcontact.scans.reading import MASKS, ReadingOptions
from hardcontact.surfaces.levelling import LEVELLING_METHODS

#: Width (nm) and unit of scans in place of a faulty --size and --unit, until the fault is reported.
#: Nothing is written.
PLACEHOLDER_SIZE, PLACEHOLDER_UNIT = 1000.0, "nm"


class CommandLine(ArgumentParser):
    """A parser without abbreviated options, which suggests a known word for an unknown one."""

    def __init__(self, command: str, description: str) -> None:
        """Take the command and the first text of its help."""
        super().__init__(
            command, description=description, formatter_class=RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )  # fmt: skip

    def error(self, message: str) -> NoReturn:
        """End the program with one line, which may suggest a known word."""
        question = self._spelling_question(message)
        self.exit(2, f"error: {message}{question}; {self.prog} --help lists all options\n")

    def _spelling_question(self, message: str) -> str:
        """Return a question if a message names a word that resembles a known one, or no text."""
        if "invalid choice: " in message:
            unknown_word = message.partition("invalid choice: '")[2].partition("'")[0]
            known_words = [word for action in self._actions for word in action.choices or ()]
        else:
            unknown_argument = message.partition("unrecognized arguments: ")[2].partition(" ")[0]
            unknown_word = unknown_argument.partition("=")[0]
            if unknown_word == "--diameter":
                return " (did you mean --radius, with half of it?)"
            known_words = [name for name in self._option_string_actions if name.startswith("--")]
        return spelling_question(unknown_word, known_words)


class QuantityOption(NamedTuple):
    """A quantity of the command line, or the paper's value."""

    text: str  #: As written, with its unit.
    number: float  #: In `unit`.
    unit: str  #: Unit of the key in the study.
    is_given: bool  #: Whether the user gave it.


def add_shared_options(parser: ArgumentParser) -> None:
    """Add the options of `new` and `predict`: quantities, and how scans are read."""
    for name, (key, meaning) in CONTACT_QUANTITIES.items():
        default = key_field(key).default
        parser.add_argument(f"--{name}", help=f"{meaning} (the paper's: {default})")
    parser.add_argument("--tip", help="radius of the tip, for files that do not state it")
    parser.add_argument(
        "--unit", default="none",
        help="unit of length, for files that do not state it; for points x, y, height two "
        "units, of positions and of heights, such as mm,nm",
    )  # fmt: skip
    parser.add_argument("--size", help="longer side of the scan, for files that do not state it")
    parser.add_argument(
        "--mask", choices=MASKS, default="keep",
        help="what pixels under a mask in a file are: heights, or gaps",
    )  # fmt: skip
    parser.add_argument(
        "--levelling", choices=LEVELLING_METHODS, default="plane",
        help="what is removed from height maps: a plane, errors of lines (streaks, offsets), or a "
        "quadratic polynomial",
    )  # fmt: skip


def parse_quantities(arguments: Namespace) -> tuple[dict[str, QuantityOption], list[str]]:
    """Return the quantities of the command line by name, and a line for each fault, also of --unit.

    Quantities of the contact that are missing or faulty have the paper's value.
    """
    types = {name: quantity_type(key) for name, (key, _) in CONTACT_QUANTITIES.items()}
    types |= {"tip": TIP_RADIUS, "size": quantity_type("scan.map_size")}
    types["modulus"] = types["hardness"]  # The same unit and bounds.
    quantities = {}
    faults: list[str] = []
    with collect_faults(faults, "--unit: "):
        UNIT.check(arguments.unit)
    for name, quantity in types.items():
        text = getattr(arguments, name, None)
        if text is not None:
            with collect_faults(faults, f"--{name}: "):
                number = quantity.number(text)
                quantities[name] = QuantityOption(
                    text.strip(), number, quantity.unit, is_given=True
                )
        if name in CONTACT_QUANTITIES and name not in quantities:
            paper_text = key_field(CONTACT_QUANTITIES[name][0]).default
            number = quantity.number(paper_text)
            quantities[name] = QuantityOption(paper_text, number, quantity.unit, is_given=False)
    return quantities, faults


def contact_of_quantities(
    quantities: Mapping[str, QuantityOption], contacts_per_row: int = 1
) -> Contact:
    """Return the contact that the quantities of the command line describe."""
    fields: dict[str, Any] = {name: quantities[name].number for name in CONTACT_QUANTITIES}
    rho = fields.pop("range")
    return Contact(**fields, rho=rho, contacts_per_row=contacts_per_row)


def reading_options(
    arguments: Namespace, quantities: Mapping[str, QuantityOption]
) -> ReadingOptions:
    """Return the options of the command line that say how scans are read.

    `parse_quantities` reports a faulty --size or --unit. Files are then read with a placeholder,
    because otherwise each file without a size or a unit would be reported as well.
    """
    map_size: float | str = NONE
    if arguments.size is not None:
        map_size = quantities["size"].number if "size" in quantities else PLACEHOLDER_SIZE
    return ReadingOptions(
        tip_radius=quantities["tip"].number if "tip" in quantities else None,
        unit=arguments.unit if UNIT.matches(arguments.unit) else PLACEHOLDER_UNIT,
        map_size=map_size,
        levelling=arguments.levelling,
        mask=arguments.mask,
    )


def unit_questions(quantities: Mapping[str, QuantityOption]) -> Iterator[str]:
    """Yield a question for each unusual quantity of the contact that the user gave."""
    for name in CONTACT_QUANTITIES:
        option = quantities[name]
        question = unit_question(name, option.number)
        if option.is_given and question:
            yield f"--{name} {option.text}: {question}"
