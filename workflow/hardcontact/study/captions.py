"""Captions of the report as plain text: they are templates that name the configuration."""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

__all__ = ["caption_text"]

#: Nothing but the text itself, and an error for what is no markup.
SETTINGS = {
    "_disable_config": True,
    "file_insertion_enabled": False,
    "raw_enabled": False,
    "halt_level": 2,
}


def caption_text(template: str, configuration: Mapping[str, Any]) -> str:
    """Return a caption as the report shows it, without its markup.

    Parameters
    ----------
    template : str
        A caption of workflow/report: reStructuredText, in which a template of Jinja names keys of
        the configuration.
    configuration : mapping
        Of the study, as it was given.

    Returns
    -------
    str
        In one line.
    """
    from docutils.core import publish_doctree
    from jinja2 import Environment, StrictUndefined

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    study = SimpleNamespace(config=configuration)
    filled = environment.from_string(template).render(snakemake=study)
    return " ".join(publish_doctree(filled, settings_overrides=SETTINGS).astext().split())
