# The answer of the paper's study and the pages of its report. `snakemake --report` gathers them.

from hardcontact.report.figures.listing import PAPER_FIGURES


rule answer_paper:
    """Write the numbers of the answer, the page that shows them, and the pages of the report."""
    input:
        **{
            name: PATTERNS.dataset(name)
            for name in ("topography", "scales", "edges", "sensitivity", "sets", "features", "fit")
        },
        scan_size="resources/validation/scan_size.nc",
        claims=PATTERNS.result("claims.csv"),
        published_constants=PUBLISHED_TABLES["published_constants"],
        published_table1=PUBLISHED_TABLES["published_table1"],
        figures=[PATTERNS.figure(name, "svg") for name in PAPER_FIGURES],
        chapters=[
            f"workflow/report/{page}.md"
            for page in PAGES
            if page not in ("figures", "claims", "parameters")
        ],
        pages="workflow/report/pages.yaml",
        captions="workflow/report/figures.yaml",
        citation="CITATION.cff",
        environment=PINS[0],
        templates=page_templates(),
        code=code_inputs("answer_paper.py"),
    output:
        **{
            page: report(PATTERNS.page(page), category=category, labels={"page": title})
            for page, (category, title) in PAGES.items()
        },
        **ANSWER,
    params:
        parameters=parameters(**config),
    script:
        "../scripts/answer_paper.py"
