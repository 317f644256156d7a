# Report: its pages of text. `snakemake --report` gathers them with the figures.

from hardcontact.config.configuration import CHAPTERS, PAGES


rule write_pages:
    """Write the pages of the report: verdicts, chapters, parameters."""
    input:
        **{chapter: f"workflow/report/{chapter}.md" for chapter in CHAPTERS},
        claims=PATTERNS.result("claims.csv"),
        edges=PATTERNS.dataset("edges"),
        sets=PATTERNS.dataset("sets"),
        environment=PINS[0],
        templates=template_inputs("claims.html", "chapter.html", "parameters.html", "verdicts.html"),
        code=code_inputs("write_pages.py"),
    output:
        **{
            page: report(
                PATTERNS.page(page),
                category=category,
                labels={"page": title},
            )
            for page, (category, title) in PAGES.items()
        },
    log:
        PATTERNS.log("write_pages"),
    benchmark:
        PATTERNS.benchmark("write_pages")
    params:
        canonical=canonical(config),
    script:
        "../scripts/write_pages.py"
