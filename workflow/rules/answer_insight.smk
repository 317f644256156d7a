# The page on what decides the band: question, numbers and figure of each part.

from hardcontact.report.figures.listing import INSIGHT_FIGURES, describe_figure

#: The dataset of each figure, and the band.
INSIGHT_SOURCES = ["edges", *(describe_figure(name).inputs[0] for name in INSIGHT_FIGURES)]


rule answer_insight:
    """Write the page on what decides the band."""
    input:
        **{source: PATTERNS.dataset(source) for source in INSIGHT_SOURCES},
        claims=PATTERNS.result("insight_claims.csv"),
        statements="resources/paper/insight_claims.csv",
        figures=[PATTERNS.figure(name, "svg") for name in INSIGHT_FIGURES],
        captions="workflow/report/figures.yaml",
        templates=template_inputs(
            "verdicts.html", "insight.html", *(f"insight/{name}.html" for name in INSIGHT_FIGURES)
        ),
        published_constants=PUBLISHED_TABLES["published_constants"],
        validation="workflow/hardcontact/theory/prediction.csv",
        code=code_inputs("answer_insight.py"),
    output:
        page=report(
            PATTERNS.result("insight.html"),
            caption="../report/insight.rst",
            category="8. What decides the band",
            labels={"page": "all parts"},
        ),
    log:
        PATTERNS.log("answer_insight"),
    benchmark:
        PATTERNS.benchmark("answer_insight")
    params:
        canonical=canonical(config),
    script:
        "../scripts/answer_insight.py"
