"""Types of values of keys: quantities with a unit and two bounds, names, lists of them.

Bounds are generous: values beyond have no physical meaning here, or no computer holds them.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any

from pydantic import Field, GetCoreSchemaHandler, WrapValidator
from pydantic_core import CoreSchema, core_schema

from hardcontact.base.units import format_exact, parse_quantity
from hardcontact.config.faults import shorten

#: Largest number of characters in the name of a study.
MAX_NAME_LENGTH = 100


@dataclass(frozen=True)
class Quantity:
    """Text such as "10 uN", which becomes a number in a unit of the study, between bounds."""

    unit: str
    low: float
    high: float

    @property
    def expects(self) -> str:
        """The accepted values in words."""
        return f"{format_exact(self.low, self.unit)} to {format_exact(self.high, self.unit)}"

    def number(self, text: object) -> float:
        """Return the number of a text; refuse a text that is no quantity within the bounds."""
        value = parse_quantity(text, self.unit)
        if not self.low <= value <= self.high:
            raise ValueError(f"expected {self.expects}, found {shorten(text)}")
        return value

    def __get_pydantic_core_schema__(self, _: Any, _handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic take numbers from texts."""
        return core_schema.no_info_plain_validator_function(self.number)


@dataclass(frozen=True)
class Matching:
    """Printable text that a pattern matches as a whole, and the pattern in words."""

    pattern: str
    expects: str

    def matches(self, text: str) -> bool:
        """Return whether a text matches; a terminal would obey control characters."""
        return text.isprintable() and bool(re.fullmatch(self.pattern, text))

    def check(self, text: str) -> str:
        """Return a text that matches; refuse other texts."""
        if self.matches(text):
            return text
        raise ValueError(f"expected {self.expects}, found {shorten(text)}")

    def __get_pydantic_core_schema__(self, _type: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic check texts."""
        return core_schema.no_info_after_validator_function(self.check, handler(str))


def _validate_ascending(texts: Any, validate: Callable[[Any], list[float]]) -> list[float]:
    """Return the numbers of quantities; refuse quantities that do not ascend."""
    numbers = validate(texts)
    for index, (smaller, larger) in enumerate(pairwise(numbers)):
        if smaller >= larger:
            written = f"{texts[index + 1]} after {texts[index]}"
            raise ValueError(f"expected ascending values, found {written}")
    return numbers


def study_name(max_length: int = MAX_NAME_LENGTH) -> Matching:
    """Return the type of the name of a study, without .txt, which other files in `results` have."""
    return Matching(
        rf"(?!.*\.txt$)[A-Za-z0-9][A-Za-z0-9_.-]{{0,{max_length - 1}}}",
        f"a name of up to {max_length} letters, digits, dots, dashes and underscores, without "
        ".txt at the end",
    )


def or_word(word: str) -> WrapValidator:
    """Return a validator that accepts a word in place of other values."""
    return WrapValidator(lambda value, validate: value if value == word else validate(value))


ASCENDING = WrapValidator(_validate_ascending)

Length = Annotated[float, Quantity("nm", 0.01, 1e9)]
#: A range of adhesion. The lower bound is a tenth of the size of an atom.
Range = Annotated[float, Quantity("nm", 0.01, 1000)]
Radius = Annotated[float, Quantity("nm", 10, 1e9)]
Force = Annotated[float, Quantity("N", 1e-12, 1)]
Pressure = Annotated[float, Quantity("Pa", 1e3, 1e13)]
Work = Annotated[float, Quantity("J/m2", 1e-6, 100)]

Lengths = Annotated[list[Length], Field(min_length=1), ASCENDING]
Ranges = Annotated[list[Range], Field(min_length=1), ASCENDING]
Forces = Annotated[list[Force], Field(min_length=1), ASCENDING]
#: At most 20, because all radii stand in the name of a folder.
Radii = Annotated[list[Radius], Field(min_length=1, max_length=20), ASCENDING]

#: The bound permits 40 000 contacts on a scan.
ContactsPerRow = Annotated[int, Field(ge=1, le=200)]
ContactCount = Annotated[int, Field(ge=1, le=40000)]
MasterCount = Annotated[int, Field(ge=1, le=1000)]
#: Even, as on mirrored scans; odd numbers are not validated. The bound is `limits.MAX_MAP_PIXELS`.
Pixels = Annotated[int, Field(ge=32, le=16384, multiple_of=2)]
Fraction = Annotated[float, Field(ge=0.001, le=0.999, allow_inf_nan=False)]

SurfaceId = Annotated[str, Matching("[a-z][a-z0-9_]*", "the id of a surface")]
UNIT = Matching(
    "none|(?:m|mm|[uµ]m|nm|Å|A|angstrom|pm)(?:,(?:m|mm|[uµ]m|nm|Å|A|angstrom|pm))?",
    "none, m, mm, um, nm, angstrom or pm, or two of these, such as mm,nm",
)
FOLDER = Matching(
    r"(?=.{1,200}$)/?(?!\.)[A-Za-z0-9_.-]+(/(?!\.)[A-Za-z0-9_.-]+)*",
    "a path of letters, digits, dots, dashes and underscores, no name with a dot in front",
)
#: Snakemake takes names in braces for wildcards, and names in < and > for path variables.
FilePath = Annotated[str, Matching("[^{}<>]{1,1000}", "the path of a file, without {, }, < and >")]
