"""Captions of the report as plain text: they are templates that name the configuration."""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, NamedTuple

__all__ = ["Caption", "caption"]

#: Nothing but the text itself, and an error for what is no markup.
SETTINGS = {
    "_disable_config": True,
    "file_insertion_enabled": False,
    "raw_enabled": False,
    "halt_level": 2,
}


class Caption(NamedTuple):
    """A caption in plain text.

    Attributes
    ----------
    title : str
        What stands in bold before it, without the full stop.
    text : str
        The rest, in one line.
    """

    title: str
    text: str


def caption(template: str, configuration: Mapping[str, Any]) -> Caption:
    """Return a caption as the report shows it, without its markup.

    Parameters
    ----------
    template : str
        A caption of workflow/report: reStructuredText that begins with its title in bold, and in
        which a template of Jinja names keys of the configuration.
    configuration : mapping
        Of the study, as it was given.

    Returns
    -------
    Caption
        Title and text.

    Raises
    ------
    ValueError
        If the caption does not begin with a title.
    """
    from docutils.core import publish_doctree
    from docutils.nodes import strong
    from jinja2 import Environment, StrictUndefined

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    study = SimpleNamespace(config=configuration)
    filled = environment.from_string(template).render(snakemake=study)
    document = publish_doctree(filled, settings_overrides=SETTINGS)
    whole = " ".join(document.astext().split())
    bold = [" ".join(node.astext().split()) for node in document.findall(strong)]
    if not bold or not whole.startswith(bold[0]):
        raise ValueError(f"expected a caption that begins with its title in bold, found {whole!r}")
    return Caption(bold[0].removesuffix("."), whole.removeprefix(bold[0]).strip())
