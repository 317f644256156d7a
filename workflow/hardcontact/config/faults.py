"""Faults of the user's input: one line each, all of them at once.

A function that refuses or checks raises ValueError, whose message has one line for each fault.
"""

import datetime
import difflib
import re
import reprlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

#: The accepted values in words, for types of errors that pydantic explains to programmers.
EXPECTED_VALUES = {
    "bool_type": "true or false",
    "dict_type": "a mapping",
    "float_parsing": "a number",
    "int_type": "a whole number",
    "model_type": "a mapping",
}
#: The words around the accepted values in pydantic's other messages, such as "Input should be
#: less than or equal to 200" and "List should have at least 1 item after validation, not 0".
PYDANTIC_PHRASES = re.compile(r"^\w+ should (be|have) |\bvalid | after validation, not \d+$|'")
#: How many faults are reported at once, so that a screen holds them.
MAX_LINES = 30
#: Smallest similarity of a name and the known name that it may mean: one letter in four may differ.
SIMILARITY = 0.75

Model = TypeVar("Model", bound=BaseModel)


def key_fault(key: str, accepted: object, value: object) -> str:
    """Return the line of a fault of a key."""
    return f"config key {key}: expected {accepted}, found {value}"


def raise_faults(lines: Iterable[str]) -> None:
    """Raise ValueError with each line once, if there are any; beyond MAX_LINES count them."""
    reported = [*dict.fromkeys(lines)]
    if len(reported) > MAX_LINES:
        reported[MAX_LINES - 1 :] = [f"and {len(reported) - MAX_LINES + 1} more faults, not shown"]
    if reported:
        raise ValueError("\n".join(reported))


@contextmanager
def collect_faults(faults: list[str], prefix: str = "") -> Iterator[None]:
    """Append the lines of a ValueError that the block raises to faults, each after the prefix."""
    try:
        yield
    except ValueError as error:
        faults += [prefix + line for line in str(error).splitlines()]


def spelling_question(name: str, known_names: Iterable[str]) -> str:
    """Return a question with the known name that a name resembles, or no text."""
    similar = difflib.get_close_matches(name, sorted(known_names), n=1, cutoff=SIMILARITY)
    return f" (did you mean {similar[0]}?)" if similar else ""


def quote_key(key: object) -> str:
    """Return a key or a cell as written, or escaped and shortened to fit a line."""
    text = str(key) or "nothing"
    return text if text.strip() and text.isprintable() and len(text) < 80 else shorten(key)


def shorten(value: object) -> str:
    """Return a value as written, on one line of limited length."""
    if isinstance(value, datetime.date):
        return str(value)
    short = reprlib.Repr()
    short.maxstring = short.maxother = 80
    short.maxlevel = 2
    return short.repr(value)


def validate(model: type[Model], value: object, prefix: str = "") -> Model:
    """Return YAML, or a row of a table, as a model's instance; messages begin with the prefix."""
    try:
        return model.model_validate(value)
    except ValidationError as error:
        raise_faults(_fault_lines(model, error, prefix))
        raise  # Only a validation error without any fault would come here.


def _fault_lines(model: type[BaseModel], error: ValidationError, prefix: str) -> list[str]:
    """Return a line for each faulty key, and one for the unknown keys of each section."""
    faults = dict[str, str]()
    unknown = dict[tuple[int | str, ...], list[str]]()
    for fault in error.errors(include_url=False):
        location = fault["loc"]
        if fault["type"] in ("extra_forbidden", "invalid_key"):
            unknown.setdefault(location[:-1], []).append(quote_key(location[-1]))
        elif not location and fault["type"] == "value_error":  # a rule across keys
            lines = str(fault["ctx"]["error"]).splitlines()
            return [prefix.removesuffix("config key ") + line for line in lines]
        else:
            faults.setdefault(_join_key(location), _describe_fault(fault))
    for keys, names in unknown.items():
        faults[_join_key(keys)] = _describe_unknown(model, section_model(model, keys), names)
    return [f"{prefix}{key}: {faults[key]}" for key in sorted(faults)]


def _join_key(location: tuple[int | str, ...]) -> str:
    """Return a key as one text, with dots between the names that lead to it."""
    return ".".join(map(quote_key, location)) or "(top level)"


def section_model(model: type[BaseModel], names: Iterable[int | str]) -> type[BaseModel]:
    """Return the model of a section, by the names of the sections that lead to it."""
    for name in names:
        annotation: Any = model.model_fields[str(name)].annotation
        model = annotation
    return model


def _describe_fault(fault: Mapping[str, Any]) -> str:
    """Return the accepted values and the faulty one in words."""
    if fault["type"] == "value_error":
        return str(fault["ctx"]["error"])
    words = PYDANTIC_PHRASES.sub("", fault["msg"].replace("''", "nothing"))
    accepted = EXPECTED_VALUES.get(fault["type"], words)
    return f"expected {accepted}, found {shorten(fault['input'])}"


def _describe_unknown(model: type[BaseModel], section: type[BaseModel], names: list[str]) -> str:
    """Return the accepted keys of a section, and the known keys that unknown names resemble."""
    known_keys = list(section.model_fields)
    spelling = {key: _key_in_yaml(key) for key, _ in key_fields(model)}
    # A name that several sections have stands for the first.
    spelling |= {key.rpartition(".")[2]: text for key, text in reversed(spelling.items())}
    spelling |= {key: key for key in known_keys}
    matches = [difflib.get_close_matches(name, spelling, n=1, cutoff=SIMILARITY) for name in names]
    suggestions = ", ".join(dict.fromkeys(spelling[key] for keys in matches for key in keys))
    accepted = "a key that exists" if all(matches) else f"one of {', '.join(known_keys)}"
    question = f" (did you mean {suggestions}?)" if suggestions else ""
    return f"expected {accepted}; found {', '.join(sorted(names))[:200]}{question}"


def key_fields(section: type[BaseModel], prefix: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Yield the keys of a section and of the sections in it, each with its field."""
    for name, field in section.model_fields.items():
        if isinstance(field.default, BaseModel):
            yield from key_fields(type(field.default), f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", field


def _key_in_yaml(key: str) -> str:
    """Return a key as YAML has it on one line, such as ``contact: {hardness: ...}``."""
    *sections, name = key.split(".")
    opened = "".join(f"{section}: {{" for section in sections)
    return f"{opened}{name}: ...{'}' * len(sections)}" if sections else name
