# The page of the paper's study: question, answer, figures in their order, verdicts, departures.


rule answer_paper:
    """Write the page that tells the story of the study, and its numbers."""
    input:
        **{
            name: PATTERNS.dataset(name)
            for name in (
                "topography",
                "scales",
                "edges",
                "sets",
                "protruded",
                "protruded_sphere",
            )
        },
        scan_size="resources/validation/scan_size.nc",
        claims=PATTERNS.result("claims.csv"),
        published_constants=PUBLISHED_TABLES["published_constants"],
        published_table1=PUBLISHED_TABLES["published_table1"],
        figures=[PATTERNS.figure(name, "svg") for name in PAPER_FIGURES],
        captions=[f"workflow/hardcontact/report/figures/{name}.py" for name in PAPER_FIGURES],
        citation="CITATION.cff",
        templates=template_inputs("paper.html", "paper_headline.txt", "verdicts.html"),
        code=code_inputs("answer_paper.py"),
    output:
        page=report(
            PATTERNS.result("answer.html"),
            caption="../report/answer.rst",
            category="0. Answer",
            labels={"page": "the answer"},
        ),
        json=PATTERNS.result("answer.json"),
    log:
        PATTERNS.log("answer_paper"),
    benchmark:
        PATTERNS.benchmark("answer_paper")
    params:
        canonical=canonical(config),
    script:
        "../scripts/answer_paper.py"
