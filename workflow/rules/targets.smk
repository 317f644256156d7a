# Named targets: what each stage leaves in the results, figures one by one, and the check of files.

from hardcontact.report.figures.listing import FILE_KINDS, PAPER_FIGURES

#: The datasets of each target that makes some; `fit` of the user's surfaces needs measured forces.
if IS_PAPER_STUDY:
    DATASETS_OF_TARGETS = {
        "topography": ["topography"],
        "adhesion": ["adhesion", "contact"],
        "elastic": ["elastic"],
        "plasticity": ["indent", "edge_shifts"],
        "asperities": ["asperities"],
        "scales": ["scales", "edges", "sensitivity", "band_forces", "exponents"],
        "fit": ["fit"],
        "classical": ["classical"],
        "sets": ["sets", "posterior", "features"],
    }
else:
    DATASETS_OF_TARGETS = {
        "topography": ["topography", "spectra"],
        "adhesion": ["adhesion"],
        "scales": ["scales", "edges", "sensitivity"],
        "force": ["force"],
        **({"fit": ["fit"]} if HAS_FORCES else {}),
    }
FIGURE_FILES = {
    figure: [RESULTS.figure(figure, kind) for kind in FILE_KINDS]
    for figure in (PAPER_FIGURES if IS_PAPER_STUDY else [])
}
TARGETS = {
    target: [RESULTS.dataset(name) for name in names]
    for target, names in DATASETS_OF_TARGETS.items()
}
if IS_PAPER_STUDY:
    TARGETS["claims"] = [RESULTS.result("claims.csv")]
    TARGETS["figures"] = list(FIGURE_FILES.values())
    TARGETS["pages"] = [RESULTS.page(page) for page in PAGES]
    TARGETS["answer"] = rules.answer_paper.output
else:
    TARGETS["answer"] = rules.answer_surfaces.output


for target, files in (TARGETS | FIGURE_FILES).items():

    rule:
        """Make one stage of the study, or one figure, and what it needs."""
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
