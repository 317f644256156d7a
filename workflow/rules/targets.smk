# Named targets: what each stage leaves in the results, and figures one by one.

from hardcontact.config.configuration import available_targets
from hardcontact.report.figures.listing import FILE_KINDS, PAPER_FIGURES

#: The datasets of each target that makes some.
DATASETS_OF_TARGETS = {
    "topography": ["topography"] if COMPARED else ["topography", "spectra"],
    "adhesion": ["adhesion", "contact"] if COMPARED else ["adhesion"],
    "elastic": ["elastic"],
    "plasticity": ["indent", "enhancement"],
    "asperities": ["asperities"],
    "scales": ["scales", "edges", "sensitivity", *(["scaling"] if COMPARED else [])],
    "classical": ["classical"],
    "sets": ["sets", "posterior", "features"],
    "force": ["force"],
    "fit": ["fit"],
}
FIGURE_FILES = {
    figure: [PATTERNS.figure(figure, kind) for kind in FILE_KINDS] for figure in PAPER_FIGURES
}
FILES_OF_TARGETS = {
    **{
        target: [PATTERNS.dataset(name) for name in names]
        for target, names in DATASETS_OF_TARGETS.items()
    },
    "claims": [PATTERNS.result("claims.csv")],
    "figures": list(FIGURE_FILES.values()),
    "pages": [PATTERNS.page(page) for page in PAGES],
    "answer": (rules.answer_paper if COMPARED else rules.answer_surfaces).output,
}


for target in available_targets(STUDY):

    rule:
        """Make one stage of the study, and what it needs."""
        name:
            target
        input:
            FILES_OF_TARGETS[target],


for figure in PAPER_FIGURES if COMPARED else []:

    rule:
        """Make one figure, from nothing if need be."""
        name:
            figure
        input:
            FIGURE_FILES[figure],
