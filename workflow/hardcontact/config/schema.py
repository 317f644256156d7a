"""Values checked against a JSON schema: a line for the fault of each key, in words for users.

The schemas have keywords of their own. Of quantities: `unit`, and `between`, the least and the
largest value in that unit. Of patterns: `expects`, which says in words what matches. `paper` and
`recomputes` are for the tables of the documentation (`key_tables`).
"""

import datetime
import difflib
import math
import re
import reprlib
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

import jsonschema

from hardcontact.numbers.units import QUANTITIES, magnitude

#: How the message names what a keyword of a schema expects.
EXPECTED = {
    "const": "{}",
    "maxItems": "at most {} entries",
    "maxLength": "at most {} characters",
    "maximum": "at most {}",
    "minItems": "at least {} entries",
    "minLength": "at least {} characters",
    "minimum": "at least {}",
    "multipleOf": "a multiple of {}",
    "pattern": "text that matches {}",
    "type": "{}",
    "uniqueItems": "each entry once",
}

#: The types of a schema in words of YAML.
TYPES = {
    "array": "a list",
    "boolean": "true or false",
    "integer": "a whole number",
    "number": "a number",
    "object": "a mapping",
    "string": "text",
}

#: How many faults of one schema are told at once, and how many of a file.
FAULTS, LINES = 10, 100
#: How alike an unknown key and a known one are, of 1, if the latter was meant: a letter or two.
NEAR = 0.75

Schema = Mapping[str, Any]


def refuse(value: object, schema: Schema, where: str) -> None:
    """Raise an error that says what is wrong with the keys of a value of YAML or of a table.

    A ValueError has, after the text `where`, a line each for the first FAULTS keys at fault in a
    JSON schema: the key, what was expected, what was found.
    """
    try:
        faults: dict[str, jsonschema.ValidationError] = {}
        for fault in _Validator(schema).iter_errors(value):
            key = ".".join(map(plain, fault.absolute_path)) or "(top level)"
            faults.setdefault(key, fault)
        lines = [f"{where}{key}: {_sentence(faults[key])}" for key in sorted(faults)[:FAULTS]]
    except RecursionError:
        lines = [f"{where}(top level): expected a few levels of keys and lists, found too many"]
    refuse_lines(lines)


def refuse_lines(lines: Iterable[str]) -> None:
    """Raise a ValueError of lines, each a fault, if there are any; of too many the first are told.

    There are LINES at most: the last one counts those that are not told.
    """
    first = [*lines]
    if len(first) > LINES:
        first[LINES - 1 :] = [f"expected fewer faults, found {len(first) - LINES + 1} more"]
    if first:
        raise ValueError("\n".join(first))


def resolved(schema: Schema, root: Schema) -> Schema:
    """Return a part of a schema together with the definition in `root` that it refers to."""
    if "$ref" not in schema:
        return schema
    return {**root["$defs"][schema["$ref"].rsplit("/", 1)[1]], **schema}


def plain(key: object) -> str:
    """Return a key as it stands in a file, or escaped and shortened if it would not fit a line."""
    text = str(key)
    return text if text.strip() and text.isprintable() and len(text) < 80 else _shortened(key)


def _is_integer(_checker: object, value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(checker: object, value: object) -> bool:
    # Neither text nor truth, and something that can be compared: no infinity, no NaN.
    return _is_integer(checker, value) or isinstance(value, float) and math.isfinite(value)


def _check_pattern(
    _validator: object, pattern: str, value: object, _schema: Schema
) -> Iterator[jsonschema.ValidationError]:
    # All of the text must match: a search would accept a line break at its end. A terminal would
    # obey what is not printable.
    if isinstance(value, str) and not (value.isprintable() and re.fullmatch(pattern, value)):
        yield jsonschema.ValidationError("")


def _check_unit(
    _validator: object, unit: str, value: object, schema: Schema
) -> Iterator[jsonschema.ValidationError]:
    try:
        low, high = schema["between"]
        if not low <= magnitude(value, unit) <= high:
            yield jsonschema.ValidationError(
                f"expected {low:g} to {high:g} {unit}, found {_shortened(value)}"
            )
    except ValueError as error:
        yield jsonschema.ValidationError(str(error))


_base = jsonschema.Draft202012Validator
_Validator = jsonschema.validators.extend(  # type: ignore[no-untyped-call]
    _base,
    {"pattern": _check_pattern, "unit": _check_unit},
    type_checker=_base.TYPE_CHECKER.redefine_many({"integer": _is_integer, "number": _is_number}),
)


def _shortened(value: object) -> str:
    """Return a value as it was given, on one line of limited length."""
    if isinstance(value, datetime.date):
        return str(value)
    short = reprlib.Repr()
    short.maxstring = short.maxother = 80
    short.maxlevel = 2
    return short.repr(value)


def _sentence(fault: Any) -> str:
    """Return what was expected and what was found."""
    if fault.validator == "additionalProperties":
        known = set(fault.schema["properties"])
        unknown = sorted(plain(key) for key in fault.instance if key not in known)
        return (
            f"expected one of {', '.join(fault.schema['properties'])}; "
            f"found {', '.join(unknown)[:200]}{_meant(unknown, known)}"
        )
    if fault.validator == "required":
        missing = ", ".join(sorted(set(fault.schema["required"]) - set(fault.instance)))
        return f"expected all of {', '.join(fault.schema['required'])}; found no {missing}"
    if fault.validator == "oneOf":
        return "; or ".join(_sentence(choice) for choice in fault.context)
    if fault.validator == "unit":
        return str(fault.message)
    if fault.validator == "type" and "unit" in fault.schema:
        expected = QUANTITIES[fault.schema["unit"]]
    elif fault.validator == "enum":
        expected = " or ".join(choice or "nothing" for choice in fault.validator_value)
    elif fault.validator == "type":
        expected = TYPES[fault.validator_value]
    elif fault.validator == "pattern" and "expects" in fault.schema:
        expected = fault.schema["expects"]
    else:
        expected = EXPECTED[fault.validator].format(fault.validator_value)
    return f"expected {expected}, found {_shortened(fault.instance)}"


def _meant(unknown: Iterable[str], known: Collection[str]) -> str:
    """Return a question for the keys that unknown ones are nearly, or nothing."""
    near = (difflib.get_close_matches(key, known, 1, NEAR) for key in unknown)
    meant = ", ".join(dict.fromkeys(key for keys in near for key in keys))
    return f" (did you mean {meant}?)" if meant else ""
