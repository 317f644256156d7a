# Figures: drawn from the final datasets and published tables alone, by the study and by redraw.smk.

from hardcontact.report.figures.listing import PAPER_FIGURES, caption, describe_figure

for name in PAPER_FIGURES:
    figure = describe_figure(name)

    rule:
        """Draw a figure."""
        name:
            f"draw_{name}"
        input:
            **{
                source: PUBLISHED_TABLES.get(source, PATTERNS.dataset(source))
                for source in figure.inputs
            },
            code=code_inputs("draw_figure.py", f"hardcontact.report.figures.{name}"),
        output:
            pdf=PATTERNS.figure(name, "pdf"),
            png=report(
                PATTERNS.figure(name, "png"),
                caption="../report/figure.rst",
                category=figure.chapter,
                labels={"figure": figure.title},
            ),
            svg=PATTERNS.figure(name, "svg"),
        params:
            parameters=parameters(figure=name, title=figure.title, inputs=figure.inputs),
            caption="\n\n".join(caption(name, config)[:3]),
        script:
            "../scripts/draw_figure.py"
