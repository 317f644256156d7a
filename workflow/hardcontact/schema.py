"""Values held against a schema: the first fault in one line, in words for users."""

import math
import re
import reprlib

import jsonschema

from hardcontact.units import magnitude

__all__ = ["plain", "refuse"]

#: What a keyword of a schema expects.
EXPECTED = {
    "const": "{}",
    "enum": "one of {}",
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


def refuse(value, schema, where):
    """Raise ValueError that says in one line what is wrong with a value, if anything is.

    schema: JSON schema with two keywords of its own, `unit` and `between`, of quantities; where:
    what stands before the key in the message.
    """
    try:
        fault = min(_Validator(schema).iter_errors(value), key=_key, default=None)
        said = fault and f"{where}{_key(fault)}: {_said(fault)}"
    except RecursionError:
        said = f"{where}(top level): expected a few levels of keys and lists, found too many"
    if said:
        raise ValueError(said)


def _is_integer(_checker, value):
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(checker, value):
    # Neither text nor truth, and something that can be compared: no infinity, no NaN.
    return _is_integer(checker, value) or isinstance(value, float) and math.isfinite(value)


def _check_pattern(_validator, pattern, value, _schema):
    # All of the text must match: a search would let a line break pass at its end.
    if isinstance(value, str) and not re.fullmatch(pattern, value):
        yield jsonschema.ValidationError("")


def _check_unit(_validator, unit, value, schema):
    try:
        low, high = schema["between"]
        if not low <= magnitude(value, unit) <= high:
            yield jsonschema.ValidationError(
                f"expected {low:g} to {high:g} {unit}, found {_shown(value)}"
            )
    except ValueError as error:
        yield jsonschema.ValidationError(str(error))


_base = jsonschema.Draft202012Validator
_Validator = jsonschema.validators.extend(
    _base,
    {"pattern": _check_pattern, "unit": _check_unit},
    type_checker=_base.TYPE_CHECKER.redefine_many({"integer": _is_integer, "number": _is_number}),
)


def _key(fault):
    return ".".join(map(plain, fault.absolute_path)) or "(top level)"


def plain(key):
    """A key as it stands in a file, or escaped and shortened where it would not fit the line."""
    text = str(key)
    return text if text.strip() and text.isprintable() and len(text) < 80 else _shown(key)


def _shown(value):
    """What was found, on one line and not much of it."""
    short = reprlib.Repr()
    short.maxstring = short.maxother = 80
    return short.repr(value)


def _said(fault):
    if fault.validator == "additionalProperties":
        known = set(fault.schema["properties"])
        unknown = ", ".join(sorted(plain(key) for key in fault.instance if key not in known))
        return f"expected one of {', '.join(fault.schema['properties'])}; found {unknown[:200]}"
    if fault.validator == "required":
        missing = ", ".join(sorted(set(fault.schema["required"]) - set(fault.instance)))
        return f"expected all of {', '.join(fault.schema['required'])}; found no {missing}"
    if fault.validator == "oneOf":
        return "; or ".join(_said(choice) for choice in fault.context)
    if fault.validator == "unit":
        return fault.message
    if fault.validator == "type" and "unit" in fault.schema:
        expected = f"a number with a unit of {fault.schema['unit']}"
    elif fault.validator == "type":
        expected = TYPES[fault.validator_value]
    elif fault.validator == "pattern":
        expected = fault.schema.get("description", f"text that matches {fault.validator_value}")
    else:
        expected = EXPECTED[fault.validator].format(fault.validator_value)
    return f"expected {expected}, found {_shown(fault.instance)}"
