# The page that answers for own surfaces, and its figures.

from hardcontact.config.configuration import (
    contact_words,
    omitted_targets,
    quantities_of_paper,
    read_yaml,
)
from hardcontact.config.model import NONE
from hardcontact.report.figures.listing import FILE_KINDS, OWN_FIGURES

OWN_FIGURES = [name for name in OWN_FIGURES if name != "works" or STUDY["forces"] != NONE]


rule answer_surfaces:
    """Write the numbers of the answer, its figures, then the page that shows them."""
    input:
        **{
            name: PATTERNS.dataset(name)
            for name in ("topography", "spectra", "edges", "force", "sensitivity")
        },
        fit=[] if STUDY["forces"] == NONE else PATTERNS.dataset("fit"),
        code=code_inputs("answer_surfaces.py"),
        templates=template_inputs(
            "answer.html",
            "own_part.html",
            "own_headline.txt",
            "own_caution.txt",
            "own_next.txt",
            "own_fit.txt",
            "substitutes.txt",
        ),
        captions="workflow/report/figures.yaml",
        citation="CITATION.cff",
        pairs="resources/adhesion/pairs.csv",
    output:
        **{kind: [PATTERNS.figure(name, kind) for name in OWN_FIGURES] for kind in FILE_KINDS},
        page=report(
            PATTERNS.result("answer.html"),
            caption="../report/answer.rst",
            category="0. Answer",
            labels={"page": "the answer"},
        ),
        json=PATTERNS.result("answer.json"),
    log:
        PATTERNS.log("answer_surfaces"),
    benchmark:
        PATTERNS.benchmark("answer_surfaces")
    params:
        canonical=parameters(
            study=STUDY["study"],
            effort=STUDY["effort"],
            contact=contact_words(STUDY),
            of_paper=quantities_of_paper(STUDY),
            left_out=list(omitted_targets(STUDY).items()),
            version=read_yaml("CITATION.cff")["version"],
        ),
    script:
        "../scripts/answer_surfaces.py"
