# Figures: drawn from the final datasets and published tables alone, by the study and by redraw.smk.

from hardcontact.figures.catalogue import FIGURES, OF_PAPER

for name, figure in FIGURES.items():

    rule:
        """Draw a figure, and write the table that it is drawn from."""
        name:
            f"draw_{name}"
        input:
            **{dataset: PATTERNS.dataset(dataset) for dataset in figure.datasets},
            **{table: PUBLISHED[table] for table in figure.published},
            code=code_inputs("draw_figure.py", f"hardcontact.figures.{name}"),
        output:
            pdf=PATTERNS.figure(name, "pdf"),
            png=report(
                PATTERNS.figure(name, "png"),
                caption=f"../report/{name}.rst",
                category=figure.chapter,
                labels={"figure": figure.label},
            ),
            svg=PATTERNS.figure(name, "svg"),
            csv=PATTERNS.figure(name, "csv"),
        log:
            PATTERNS.log(f"draw_{name}"),
        benchmark:
            PATTERNS.benchmark(f"draw_{name}")
        params:
            canonical=canonical({"figure": name}),
        script:
            "../scripts/draw_figure.py"


rule figures:
    """Draw all figures of the paper's story."""
    input:
        [getattr(rules, f"draw_{name}").output for name in OF_PAPER],
