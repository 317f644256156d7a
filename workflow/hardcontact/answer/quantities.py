"""The quantities of an answer: one list, in which every number has a surface and a stable name."""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from hardcontact.numbers.number import Number, plain

Quantity = dict[str, Any]


def quantity(number: Number, surface: str = "", name: str = "") -> Quantity:
    """Return a number as answer.json has it, with None for what is not known.

    Parameters
    ----------
    number : Number
        The number with its interval, unit, status and source.
    surface : str
        The surface that it belongs to; empty for a number of the whole study.
    name : str
        Its name in the list; by default that of the number.
    """
    return {"surface": surface, **plain(number), "name": name or number.name}


def numbers_within(prefix: str, mapping: Mapping[str, Any]) -> Iterator[Number]:
    """Yield the numbers among the values of a mapping, counts too, named `<prefix>_<key>`."""
    for key, value in mapping.items():
        if isinstance(value, Number):
            yield value._replace(name=f"{prefix}_{key}")
        elif isinstance(value, int) and not isinstance(value, bool):
            yield Number(f"{prefix}_{key}", value)


def answer_json(head: Mapping[str, Any], quantities: Iterable[Quantity]) -> str:
    """Return the text of answer.json: the head, and the list, as answer.schema.json describes it.

    Two quantities of one surface with the same name are a ValueError.
    """
    rows = list(quantities)
    names = [(row["surface"], row["name"]) for row in rows]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise ValueError(f"expected quantities with different names, found twice: {repeated}")
    content = {**head, "quantities": rows}
    return json.dumps(content, ensure_ascii=False, allow_nan=False, indent=1) + "\n"
