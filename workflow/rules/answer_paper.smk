# The figures, the answer of the paper's study, and the pages of its report, which
# `snakemake --report` gathers. ../redraw.smk makes them again from datasets.
# Names in capitals that are not defined here: common.smk.

from hardcontact.records.code import ENVIRONMENT_PINS, code_inputs, page_templates
from hardcontact.report.figures.listing import PAPER_FIGURES, render_description

#: The datasets of the study whose numbers the answer has.
DATASETS_OF_ANSWER = (
    "topography",
    "filtered_forces",
    "edges",
    "edge_shifts",
    "sensitivity",
    "band_forces",
    "sets",
    "features",
    "fit",
)

for name in PAPER_FIGURES:
    figure = render_description(name, config)

    rule:
        """Draw a figure."""
        name:
            f"draw_{name}"
        input:
            **{
                source: PUBLISHED_TABLES.get(source, RESULTS.dataset(source))
                for source in figure.inputs
            },
            code=code_inputs("draw_figure.py", f"hardcontact.report.figures.{name}"),
        output:
            pdf=RESULTS.figure(name, "pdf"),
            png=report(
                RESULTS.figure(name, "png"),
                caption="../report/figure.rst",
                category=figure.chapter,
                labels={"figure": figure.title},
            ),
            svg=RESULTS.figure(name, "svg"),
        params:
            parameters=dict(figure=name, title=figure.title, inputs=figure.inputs),
            caption="\n\n".join([figure.title, figure.caption, figure.details]),
        script:
            "../scripts/draw_figure.py"


rule answer_paper:
    """Write the numbers of the answer, the page that shows them, and the pages of the report."""
    input:
        datasets=[
            *(RESULTS.dataset(name) for name in DATASETS_OF_ANSWER),
            "resources/validation/scan_size.nc",
        ],
        claims=RESULTS.result("claims.csv"),
        published_constants=PUBLISHED_TABLES["published_constants"],
        published_table1=PUBLISHED_TABLES["published_table1"],
        figures=[RESULTS.figure(name, "svg") for name in PAPER_FIGURES],
        chapters=[
            f"workflow/report/{page}.md"
            for page in PAGES
            if page not in ("figures", "claims", "parameters")  # These have no Markdown file.
        ],
        pages="workflow/report/pages.yaml",
        captions="workflow/report/figures.yaml",
        citation="CITATION.cff",
        environment=ENVIRONMENT_PINS,
        templates=page_templates(),
    output:
        **{
            page: report(RESULTS.page(page), category=category, labels={"page": title})
            for page, (category, title) in PAGES.items()
        },
        **ANSWER,
    params:
        parameters=config,
    script:
        "../scripts/answer_paper.py"
