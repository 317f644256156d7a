"""Captions of the report for a page: templates as plain text."""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, NamedTuple

#: Nothing but the text itself, and an error for what is no markup.
SETTINGS = {
    "_disable_config": True,
    "file_insertion_enabled": False,
    "raw_enabled": False,
    "halt_level": 2,
}


class Caption(NamedTuple):
    """A caption in plain text."""

    title: str  #: What stands in bold before it, without the full stop.
    short: str  #: The rest of the first paragraph, in one line.
    more: str = ""  #: The other paragraphs, in one line.


def caption(template: str, configuration: Mapping[str, Any]) -> Caption:
    """Return a caption as the report shows it, without its markup.

    The template is a caption of workflow/report: reStructuredText in which a template of Jinja
    names keys of the configuration, as it was given. It begins with its title in bold, or is a
    ValueError.
    """
    from docutils.core import publish_doctree
    from docutils.nodes import paragraph, strong
    from jinja2 import Environment, StrictUndefined

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    study = SimpleNamespace(config=configuration)
    filled = environment.from_string(template).render(snakemake=study)
    document = publish_doctree(filled, settings_overrides=SETTINGS)
    paragraphs, bold = (
        [" ".join(node.astext().split()) for node in document.findall(kind)] or [""]
        for kind in (paragraph, strong)
    )
    first, *others = paragraphs
    if not bold[0] or not first.startswith(bold[0]):
        raise ValueError(f"expected a caption that begins with its title in bold, found {first!r}")
    title, short = bold[0].removesuffix("."), first.removeprefix(bold[0]).strip()
    return Caption(title, short, " ".join(others))
