"""Catalogue of the figures: place in the report, title and datasets of each.

The module of a figure has its name. Both of its functions, `draw` and `table`, take the datasets
and published tables of the figure as arguments of the names given here. The catalogue imports
neither these modules nor matplotlib, so that the rules can be made from it.
"""

from typing import NamedTuple


class Figure(NamedTuple):
    """Place in the report, title and inputs of one figure."""

    chapter: str  # of the report
    label: str  # in the report
    title: str  # of its files
    datasets: tuple[str, ...]  # final ones that it is drawn from, by the names of their files
    published: tuple[str, ...] = ()  # tables, keys of `config.patterns.PUBLISHED`

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of all that the figure is drawn from."""
        return (*self.datasets, *self.published)


#: The figures of the paper's story by name, in its order.
OF_PAPER = {
    "fig1": Figure(
        "1. Surfaces",
        "Fig. 1: height maps",
        "scans of the substrates and the sphere",
        ("topography",),
    ),
    "fig_elastic": Figure(
        "2. Contact",
        "elastic contact",
        "elastic contact beside hardness and rigid contact",
        ("elastic",),
    ),
    "fig5": Figure(
        "2. Contact",
        "Fig. 5: indents",
        "indents in the sphere",
        ("indent",),
        ("published_constants",),
    ),
    "fig3": Figure(
        "3. Adhesion",
        "Fig. 3: distributions of the pull-off force",
        "distributions of pull-off forces",
        ("adhesion", "inference"),
        ("published_constants", "published_pull_off"),
    ),
    "fig4": Figure(
        "3. Adhesion",
        "Fig. 4: range and work of adhesion",
        "range and work of adhesion",
        ("contact", "inference", "sets"),
        ("published_constants", "published_pull_off"),
    ),
    "fig_sets": Figure(
        "3. Adhesion",
        "many sets of substitutes",
        "range and work of adhesion of many sets of substitutes",
        ("sets", "inference"),
        ("published_constants",),
    ),
    "fig_classical": Figure(
        "4. Classical models",
        "classical models",
        "classical models of rough adhesion",
        ("classical",),
        ("published_constants",),
    ),
    "fig_asperities": Figure(
        "5. Asperities",
        "asperities that carry the force",
        "patches that carry the pull-off force",
        ("asperities", "band"),
        ("published_constants",),
    ),
    "fig6": Figure(
        "6. Scales",
        "Fig. 6: scales of roughness",
        "pull-off force without some scales of roughness",
        ("band", "scales", "sets", "closed_form"),
        ("published_constants",),
    ),
    "fig_robustness": Figure(
        "7. Robustness",
        "other choices",
        "results under other assumptions",
        ("robustness", "inference", "band"),
        ("published_constants",),
    ),
}

#: Chapter of the figures beyond the paper.
INSIGHT = "8. What decides the band"
#: The figures of that chapter by name, in the order of its page: one a part, from its dataset.
OF_INSIGHT = {
    "fig_scaling": Figure(
        INSIGHT,
        "scaling of the band",
        "edges of the band over radius, range and contact area",
        ("scaling",),
        ("published_constants",),
    ),
    "fig_scan_size": Figure(INSIGHT, "size of scans", "how large a scan must be", ("scan_size",)),
    "fig_closed_form": Figure(
        INSIGHT, "force from a spectrum", "closed form of the pull-off force", ("closed_form",)
    ),
    "fig_laws": Figure(
        INSIGHT,
        "other laws of attraction",
        "fits, ratios and band of other laws of attraction",
        ("laws",),
    ),
    "fig_statistics": Figure(
        INSIGHT,
        "scatter of forces",
        "distribution of pull-off forces by its law, computed and published",
        ("statistics",),
    ),
    "fig_elastic_limit": Figure(
        INSIGHT,
        "limit of elastic contact",
        "elastic pressure over the hardness by shortest wavelength",
        ("elastic_limit",),
    ),
}

#: All figures.
FIGURES = OF_PAPER | OF_INSIGHT
