# The page that answers for your surfaces, and its figures.
# Names in capitals that are not defined here: common.smk.

from hardcontact.config.configuration import assumed_quantities, contact_words
from hardcontact.config.user_files import read_yaml
from hardcontact.records.code import page_templates
from hardcontact.report.figures.listing import FIGURE_SUFFIXES, OWN_FIGURES

#: All figures, but `works` only with measured forces, because it shows the fit to them.
DRAWN_FIGURES = [name for name in OWN_FIGURES if name != "works" or HAS_FORCES]


rule answer_surfaces:
    """Write the numbers of the answer, its figures, then the page that shows them."""
    input:
        **{
            name: RESULTS.dataset(name)
            for name in ("topography", "spectra", "edges", "force", "sensitivity")
        },
        fit=RESULTS.dataset("fit") if HAS_FORCES else [],
        templates=page_templates(),
        captions="workflow/report/figures.yaml",
        citation="CITATION.cff",
        pairs="resources/adhesion/pairs.csv",
    output:
        **{
            suffix: [RESULTS.figure(name, suffix) for name in DRAWN_FIGURES]
            for suffix in FIGURE_SUFFIXES
        },
        **ANSWER,
    params:
        parameters=dict(
            study=STUDY["study"],
            effort=STUDY["effort"],
            contact_words=contact_words(STUDY),
            assumed=assumed_quantities(STUDY),
            version=read_yaml("CITATION.cff")["version"],
        ),
    script:
        "../scripts/answer_surfaces.py"
