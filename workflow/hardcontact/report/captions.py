"""Captions of figures, with the values of the study."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from hardcontact.base.printing import print_share
from hardcontact.report.figures.listing import describe


class Caption(NamedTuple):
    """A caption in plain text, a line each."""

    title: str
    short: str  #: The first paragraph.
    more: str = ""  #: The other paragraphs.


def caption(figure: str, configuration: Mapping[str, Any]) -> Caption:
    """Return the caption of a figure.

    Its template in the module of the figure names keys of the configuration, as Jinja does. A key
    that is not there is a jinja2.UndefinedError.
    """
    from jinja2 import Environment, StrictUndefined

    description = describe(figure)
    environment = Environment(undefined=StrictUndefined)
    environment.filters["percent"] = print_share
    text = environment.from_string(description.caption).render(configuration)
    short, *more = (" ".join(paragraph.split()) for paragraph in text.split("\n\n"))
    return Caption(description.title, short, " ".join(more))
