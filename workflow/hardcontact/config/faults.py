"""Faults of the user's input: one line each, all of them at once."""

import datetime
import difflib
import reprlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple, TypeVar

from pydantic import BaseModel, ValidationError

#: What the message of each type of pydantic's errors says was expected.
EXPECTED = {
    "bool_type": "true or false",
    "dict_type": "a mapping",
    "finite_number": "a number",
    "float_type": "a number",
    "greater_than_equal": "at least {ge}",
    "int_type": "a whole number",
    "less_than_equal": "at most {le}",
    "list_type": "a list",
    "literal_error": "{expected}",
    "model_type": "a mapping",
    "multiple_of": "a multiple of {multiple_of}",
    "string_type": "text",
    "too_long": "at most {max_length} entries",
    "too_short": "at least {min_length} entries",
}
#: Types of errors of a key that the model does not have.
UNKNOWN_KEYS = ("extra_forbidden", "invalid_key")
#: How many faults of one model are reported at once, and how many lines of all files.
MAX_FAULTS, MAX_LINES = 10, 100
#: Similarity, of 1, from which an unknown key is taken for a known one: a letter or two differ.
SIMILARITY = 0.75

Model = TypeVar("Model", bound=BaseModel)


class Limit(NamedTuple):
    """A limit of a key, or of several with "and" between them: what it expects and finds."""

    holds: bool
    key: str
    expected: object
    found: object


def violation_messages(limits: Iterable[Limit]) -> Iterator[str]:
    """Yield a line for each limit that does not hold."""
    for holds, key, expected, found in limits:
        if not holds:
            keys = "keys" if " and " in key else "key"
            yield f"config {keys} {key}: expected {expected}, found {found}"


def refuse_lines(lines: Iterable[str]) -> None:
    """Raise a ValueError of lines, each a fault, if there are any.

    There are MAX_LINES at most: the last one counts those that are not reported.
    """
    reported = [*lines]
    if len(reported) > MAX_LINES:
        more = len(reported) - MAX_LINES + 1
        reported[MAX_LINES - 1 :] = [f"expected fewer faults, found {more} more"]
    if reported:
        raise ValueError("\n".join(reported))


def refuse_all(checks: Iterable[Callable[[], Any]]) -> list[Any]:
    """Carry out all checks; return their results, or raise ValueError with each fault once."""
    results, faults = [], list[str]()
    for check in checks:
        try:
            results.append(check())
        except ValueError as error:
            faults += str(error).splitlines()
    refuse_lines(dict.fromkeys(faults))
    return results


def quote_key(key: object) -> str:
    """Return a key as a file has it, or escaped and shortened if it would not fit a line."""
    text = str(key)
    return text if text.strip() and text.isprintable() and len(text) < 80 else shorten(key)


def shorten(value: object) -> str:
    """Return a value as it was given, on one line of limited length."""
    if isinstance(value, datetime.date):
        return str(value)
    short = reprlib.Repr()
    short.maxstring = short.maxother = 80
    short.maxlevel = 2
    return short.repr(value)


def validate(model: type[Model], value: object, where: str = "") -> Model:
    """Return a value of YAML or of a table as a model.

    Raises ValueError with a line each for the first MAX_FAULTS keys at fault, which begins with
    the text `where`: the key, what was expected, what was found.
    """
    try:
        return model.model_validate(value)
    except ValidationError as error:
        lines = _lines(model, error, where)
    raise ValueError("\n".join(lines))


def _lines(model: type[BaseModel], error: ValidationError, where: str) -> list[str]:
    faults = dict[str, str]()
    unknown = dict[tuple[int | str, ...], list[str]]()
    for fault in error.errors(include_url=False):
        place = fault["loc"]
        if fault["type"] in UNKNOWN_KEYS:
            unknown.setdefault(place[:-1], []).append(quote_key(place[-1]))
        elif not place and fault["type"] == "value_error":  # a rule across keys, with their names
            lines = str(fault["ctx"]["error"]).splitlines()
            return [where.removesuffix("config key ") + line for line in lines]
        else:
            faults.setdefault(_key(place), _sentence(fault))
    for place, names in unknown.items():
        faults[_key(place)] = _unknown(list(section_model(model, place).model_fields), names)
    return [f"{where}{key}: {faults[key]}" for key in sorted(faults)[:MAX_FAULTS]]


def _key(place: tuple[int | str, ...]) -> str:
    return ".".join(map(quote_key, place)) or "(top level)"


def section_model(model: type[BaseModel], place: Iterable[int | str]) -> type[BaseModel]:
    """Return the model of a section of keys, by the names that lead to it."""
    for name in place:
        part: Any = model.model_fields[str(name)].annotation
        model = part
    return model


def _sentence(fault: Mapping[str, Any]) -> str:
    """Return what was expected of a value and what was found."""
    if fault["type"] == "value_error":
        return str(fault["ctx"]["error"])
    expected = EXPECTED[fault["type"]].format(**fault.get("ctx", {}))
    expected = expected.replace("''", "nothing").replace("'", "")
    return f"expected {expected}, found {shorten(fault['input'])}"


def _unknown(known: list[str], names: list[str]) -> str:
    """Return the expected keys, with a question for those that unknown keys resemble."""
    near = (difflib.get_close_matches(name, known, 1, SIMILARITY) for name in names)
    meant = ", ".join(dict.fromkeys(key for keys in near for key in keys))
    question = f" (did you mean {meant}?)" if meant else ""
    return f"expected one of {', '.join(known)}; found {', '.join(sorted(names))[:200]}{question}"
