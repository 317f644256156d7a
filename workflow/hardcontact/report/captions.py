"""Captions of figures, with the values of the study."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from hardcontact.base.formatting import format_share
from hardcontact.report.figures.listing import describe_figure


class Caption(NamedTuple):
    """A caption in plain text, one line a field."""

    title: str
    short: str  #: The first paragraph.
    details: str = ""  #: The other paragraphs.


def caption(figure: str, configuration: Mapping[str, Any]) -> Caption:
    """Return the caption of a figure.

    figure: name of the figure. The CAPTION of its module is a Jinja template.
    configuration: the user's configuration, whose keys the template uses.
    Returns title, first paragraph and other paragraphs, plain text.
    Raises jinja2.UndefinedError if the configuration lacks a key.
    """
    from jinja2 import Environment, StrictUndefined

    description = describe_figure(figure)
    environment = Environment(undefined=StrictUndefined)
    environment.filters["percent"] = format_share
    text = environment.from_string(description.caption).render(configuration)
    paragraphs = [" ".join(paragraph.split()) for paragraph in text.split("\n\n")]
    return Caption(description.title, paragraphs[0], " ".join(paragraphs[1:]))
