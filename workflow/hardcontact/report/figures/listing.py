"""The figures in the order of the report, and their descriptions.

A figure is a module with the same name. It has a `TITLE`, the `CHAPTER` of the report, a `CAPTION`
and a function `draw`, which returns the table of the figure and the drawing. The arguments of
`draw` are its inputs: final datasets, or keys of `config.patterns.PUBLISHED_TABLES`.
"""

import ast
from pathlib import Path
from typing import NamedTuple

#: Figures about the statements of the paper, in the order of the report.
PAPER_FIGURES = (
    "fig1",
    "fig_elastic",
    "fig5",
    "fig3",
    "fig4",
    "fig_fit",
    "fig_protruded",
    "fig_classical",
    "fig_asperities",
    "fig6",
    "fig_enhancement",
)
#: Titles of the figures of own surfaces; "works" needs own forces.
OWN_FIGURES = {
    "cutoffs": "Pull-off force without parts of the roughness",
    "maps": "Height maps",
    "spectra": "Power spectral densities",
    "forces": "Pull-off force against the range of adhesion",
    "works": "Work of adhesion that fits measured forces",
}
#: Files of each figure.
FILE_KINDS = ("pdf", "png", "svg", "csv")


class Description(NamedTuple):
    """Title, chapter of the report, caption and inputs of a figure."""

    title: str
    chapter: str
    caption: str  #: A template: `hardcontact.report.captions.caption` fills it.
    inputs: tuple[str, ...]


def describe_figure(name: str) -> Description:
    """Return the description of a figure, read from the source of its module.

    An import of the module would import matplotlib, which takes too long before the first job.

    Returns title, chapter, caption and inputs.
    """
    source = Path(__file__).with_name(f"{name}.py").read_text("utf-8")
    constants: dict[str, str] = {}
    inputs: tuple[str, ...] = ()
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
            constants[ast.unparse(node.targets[0])] = str(node.value.value)
        if isinstance(node, ast.FunctionDef) and node.name == "draw":
            inputs = tuple(argument.arg for argument in node.args.args)
    return Description(constants["TITLE"], constants["CHAPTER"], constants["CAPTION"], inputs)
