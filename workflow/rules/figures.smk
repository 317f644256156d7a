# Figures: drawn from the final datasets and published tables alone, by the study and by redraw.smk.

from hardcontact.report.captions import caption
from hardcontact.report.figures.listing import PAPER_FIGURES, describe_figure

for name in PAPER_FIGURES:

    rule:
        """Draw a figure, and write the table that it is drawn from."""
        name:
            f"draw_{name}"
        input:
            **{
                source: PUBLISHED_TABLES.get(source, PATTERNS.dataset(source))
                for source in describe_figure(name).inputs
            },
            code=code_inputs("draw_figure.py", f"hardcontact.report.figures.{name}"),
        output:
            pdf=PATTERNS.figure(name, "pdf"),
            png=report(
                PATTERNS.figure(name, "png"),
                caption="../report/figure.rst",
                category=describe_figure(name).chapter,
                labels={"figure": describe_figure(name).title},
            ),
            svg=PATTERNS.figure(name, "svg"),
            csv=PATTERNS.figure(name, "csv"),
        log:
            PATTERNS.log(f"draw_{name}"),
        benchmark:
            PATTERNS.benchmark(f"draw_{name}")
        params:
            canonical=canonical({"figure": name}),
            caption="\n\n".join(caption(name, config)),
        script:
            "../scripts/draw_figure.py"
