"""The configuration of a study: read, checked against its schema, quantities made numbers.

Every fault is a ValueError of one line: the key, what was expected, what was found.
"""

from pathlib import Path
from typing import Any

import yaml

from hardcontact.records.code import LIBRARY
from hardcontact.study.schema import Schema, plain, refuse, resolved
from hardcontact.study.units import magnitude

__all__ = ["computed_ranges", "configuration", "read_yaml", "refuse_repeated_keys"]


def read_yaml(path: str) -> Any:
    """Return a YAML file of the project, by its path from the top folder."""
    return yaml.safe_load((LIBRARY.parents[1] / path).read_text("utf-8"))


def refuse_repeated_keys(path: str | Path) -> None:
    """Refuse a YAML file that gives a key twice, of which only the last would count.

    Parameters
    ----------
    path : str or Path
        Configuration file; other faults of it are left to whoever reads it.

    Raises
    ------
    ValueError
        In one line, naming the file, the line and the key.
    """
    try:
        pending = [("", yaml.compose(Path(path).read_text("utf-8"), yaml.CSafeLoader))]
    except yaml.YAMLError:  # JSON with tabs
        return
    visited = set()  # An alias is the node that it stands for, which may even contain itself.
    while pending:
        above, node = pending.pop()
        if not isinstance(node, yaml.MappingNode) or id(node) in visited:
            continue
        visited.add(id(node))
        keys = set()
        for key, value in node.value:
            name = f"{above}{key.value}"
            if name in keys:
                raise ValueError(
                    f"{path}: line {key.start_mark.line + 1}: expected each key once, "
                    f"found {plain(name)} again"
                )
            keys.add(name)
            pending.append((f"{name}.", value))


def configuration(config: Any, schema: Schema) -> dict[str, Any]:
    """Return a configuration with every quantity as a number in the unit that its schema names.

    Parameters
    ----------
    config : dict
        As read from YAML.
    schema : mapping
        JSON schema of the configuration.

    Returns
    -------
    dict
        The same keys; lengths in nm, forces in N, pressures in Pa.

    Raises
    ------
    ValueError
        In one line, naming the key that is unknown, missing or of the wrong type, unit or size.
    """
    refuse(config, schema, "config key ")
    numbers: dict[str, Any] = _numbers(config, schema, schema)
    return numbers


def computed_ranges(config: dict[str, Any]) -> list[float]:
    """Return the ranges of adhesion (nm) of scans: those listed, and that of the masters."""
    return sorted({*config["adhesion"]["ranges"], config["scales"]["range"]})


def _numbers(value: Any, schema: Schema, root: Schema) -> Any:
    """Return the part of a configuration below one place of its schema, quantities as numbers."""
    schema = resolved(schema, root)
    if "unit" in schema:
        return magnitude(value, schema["unit"])
    if isinstance(value, dict) and "properties" in schema:
        return {key: _numbers(item, schema["properties"][key], root) for key, item in value.items()}
    if isinstance(value, list) and "items" in schema:
        return [_numbers(item, schema["items"], root) for item in value]
    return value
