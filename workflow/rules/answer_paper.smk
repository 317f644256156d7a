# The answer of the paper's study and the pages of its report. `snakemake --report` gathers them.

from hardcontact.config.configuration import CHAPTERS, PAGES
from hardcontact.report.figures.listing import PAPER_FIGURES


rule answer_paper:
    """Write the numbers of the answer, the page that shows them, and the pages of the report."""
    input:
        **{
            name: PATTERNS.dataset(name)
            for name in ("topography", "scales", "edges", "sensitivity", "sets", "features")
        },
        scan_size="resources/validation/scan_size.nc",
        claims=PATTERNS.result("claims.csv"),
        published_constants=PUBLISHED_TABLES["published_constants"],
        published_table1=PUBLISHED_TABLES["published_table1"],
        figures=[PATTERNS.figure(name, "svg") for name in PAPER_FIGURES],
        chapters=[f"workflow/report/{chapter}.md" for chapter in CHAPTERS],
        captions="workflow/report/figures.yaml",
        citation="CITATION.cff",
        environment=PINS[0],
        templates=template_inputs(
            "answer.html",
            "paper_part.html",
            "verdicts.html",
            "claims.html",
            "chapter.html",
            "parameters.html",
            "paper_headline.txt",
            "paper_features.txt",
            "substitutes.txt",
        ),
        code=code_inputs("answer_paper.py"),
    output:
        **{
            page: report(PATTERNS.page(page), category=category, labels={"page": title})
            for page, (category, title) in PAGES.items()
        },
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
