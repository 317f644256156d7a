# Named targets: datasets by subject, figures one by one, pages, and the check of files.
# Names in capitals that are not defined here: common.smk.

from hardcontact.report.figures.listing import FIGURE_SUFFIXES, PAPER_FIGURES

#: Three tables lead from a target to its files: datasets, figures, others. `fit` of your surfaces
#: needs measured forces.
if IS_PAPER_STUDY:
    DATASETS_OF_TARGETS = {
        "topography": ["topography"],
        "adhesion": ["adhesion", "contact"],
        "elastic": ["elastic"],
        "plasticity": ["indent", "edge_shifts"],
        "asperities": ["asperities"],
        "band": ["filtered_forces", "edges", "sensitivity", "band_forces", "exponents"],
        "fit": ["fit"],
        "classical": ["classical"],
        "sets": ["sets", "posterior", "features"],
    }
    FIGURE_FILES = {
        figure: [RESULTS.figure(figure, suffix) for suffix in FIGURE_SUFFIXES]
        for figure in PAPER_FIGURES
    }
    OTHER_TARGETS = {
        "claims": [RESULTS.result("claims.csv")],
        "figures": list(FIGURE_FILES.values()),
        "pages": [RESULTS.page(page) for page in PAGES],
        "answer": rules.answer_paper.output,
    }
else:
    DATASETS_OF_TARGETS = {
        "topography": ["topography", "spectra"],
        "adhesion": ["adhesion"],
        "band": ["filtered_forces", "edges", "sensitivity"],
        "force": ["force"],
        **({"fit": ["fit"]} if HAS_FORCES else {}),
    }
    FIGURE_FILES = {}
    OTHER_TARGETS = {"answer": rules.answer_surfaces.output}
TARGETS = OTHER_TARGETS | {
    target: [RESULTS.dataset(name) for name in names]
    for target, names in DATASETS_OF_TARGETS.items()
}


for target, files in (TARGETS | FIGURE_FILES).items():

    rule:
        """Make the files of a target, such as datasets or a figure, and what they need."""
        name:
            target
        input:
            files,


rule verify:
    """Check whether the files of the study match what they were made from; write nothing."""
    retries: 0
    params:
        parameters=dict(results=RESULTS.results),
    script:
        "../scripts/verify.py"
