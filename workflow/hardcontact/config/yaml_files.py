"""Read the YAML files of the project, and refuse configurations that are not plain YAML."""

import os
from pathlib import Path
from typing import Any

import yaml

from hardcontact.config.faults import quote_key
from hardcontact.records.code import ROOT

#: The most bytes of a configuration: a hundred times as many as the paper's study has.
MAX_CONFIGURATION_BYTES = 1_000_000
#: The most values of a configuration: a hundred times as many as the paper's study has.
MAX_VALUES = 100_000


def read_yaml(path: str) -> Any:
    """Return a YAML file of the project, by its path from the top folder."""
    return yaml.safe_load((ROOT / path).read_text("utf-8"))


def refuse_unreadable(path: str | Path) -> None:
    """Refuse a file that is not YAML with keys at its top."""
    if not Path(path).exists():
        raise ValueError(
            f"{path}: expected a YAML file, found none (targets stand before --configfile)"
        )
    size = os.stat(path).st_size
    if size > MAX_CONFIGURATION_BYTES:
        raise ValueError(f"{path}: expected a configuration of at most 1 MB, found {size:,} bytes")
    try:
        content = yaml.load(Path(path).read_bytes().decode("utf-8"), _StrictLoader)
        reason = quote_key(content) if content is not None else "nothing"
    except (OSError, RecursionError, ValueError, yaml.YAMLError) as error:
        text = " ".join(str(error).split())[:150]
        content = None
        reason = text if text.isprintable() else ascii(text)
    if not isinstance(content, dict):
        raise ValueError(f"{path}: expected YAML with keys at its top, found: {reason}")


class _StrictLoader(yaml.SafeLoader):
    """A loader that refuses repeated keys, of which YAML uses the last value, and nested aliases.

    A few lines of nested aliases fill the memory of the first program that copies their values.
    """

    def get_single_node(self) -> Any:
        """Return the root of a document."""
        root = super().get_single_node()
        size = _expanded_size(root, {})
        if size > MAX_VALUES:
            raise yaml.YAMLError(f"{size:.3g} values, with aliases expanded")
        return root

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        """Return the mapping of a node."""
        names = set[str]()
        for key, _ in node.value:
            name = str(key.value)
            if name in names:
                problem = f"the key {quote_key(name)} again"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
            names.add(name)
        return super().construct_mapping(node, deep)


def _expanded_size(node: Any, sizes: dict[int, int]) -> int:
    """Return the number of values of a node of YAML if each alias in it were written out."""
    if id(node) not in sizes:
        sizes[id(node)] = 1  # An alias that holds itself adds nothing.
        children = node.value if isinstance(node, yaml.CollectionNode) else []
        entries = [child if isinstance(child, tuple) else (child,) for child in children]
        sizes[id(node)] += sum(_expanded_size(item, sizes) for entry in entries for item in entry)
    return sizes[id(node)]
