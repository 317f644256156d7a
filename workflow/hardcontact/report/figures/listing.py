"""The figures that workflow/report/figures.yaml lists: for rules and pages, without matplotlib."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import yaml
from jinja2 import Environment, StrictUndefined

from hardcontact.base.formatting import format_share
from hardcontact.base.published import PUBLISHED_TABLES
from hardcontact.report import TEXTS

FIGURE_SUFFIXES = ("pdf", "png", "svg")


@dataclass(frozen=True)
class Description:
    """A figure of figures.yaml; `render_description` fills the templates in its texts."""

    title: str
    caption: str
    details: str = ""
    alt: str = ""  #: What the picture shows, for those who cannot see it.
    chapter: str = ""  #: Heading of a group of figures in the report of the paper's study.
    inputs: tuple[str, ...] = ()  #: Final datasets, or keys of `base.published.PUBLISHED_TABLES`.


_LISTED = yaml.safe_load((TEXTS / "figures.yaml").read_text("utf-8"))
PAPER_FIGURES = tuple(_LISTED["paper"])
OWN_FIGURES = tuple(_LISTED["own"])  #: "works" is drawn only with measured forces.


def describe_figure(name: str) -> Description:
    """Return the description of a figure of the paper's study or of your surfaces."""
    return Description(**(_LISTED["paper"] | _LISTED["own"])[name])


def render_description(name: str, facts: Mapping[str, Any]) -> Description:
    """Return the description of a figure, with its templates filled by facts."""
    environment = Environment(undefined=StrictUndefined)
    environment.filters["percent"] = format_share
    figure = describe_figure(name)
    texts: dict[str, Any] = {}
    for key in ("title", "caption", "details", "alt"):
        texts[key] = environment.from_string(getattr(figure, key)).render(facts)
    if figure.inputs:
        sources = [PUBLISHED_TABLES.get(source, f"{source}.nc") for source in figure.inputs]
        texts["details"] += f" Drawn from {', '.join(sources)}."
    return replace(figure, **texts)
