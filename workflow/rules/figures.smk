# Figures: drawn from the aggregated datasets alone.


def pictures(name):
    """A figure's files; the picture goes into the report with its caption."""
    folder = f"{RESULTS}/figures/{name}"
    return {
        "pdf": f"{folder}.pdf",
        "png": report(f"{folder}.png", caption=f"../report/{name}.rst", category="Figures"),
        "csv": f"{folder}.csv",
    }


rule draw_fig1:
    input:
        topography=rules.aggregate_topography.output[0],
        code=code("draw_fig1.py"),
    output:
        **pictures("fig1"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig1.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig1.tsv"
    script:
        "../scripts/draw_fig1.py"


rule draw_fig3:
    input:
        adhesion=rules.aggregate_adhesion.output[0],
        inference=rules.infer.output[0],
        code=code("draw_fig3.py"),
    output:
        **pictures("fig3"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig3.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig3.tsv"
    script:
        "../scripts/draw_fig3.py"


rule draw_fig4:
    input:
        contact=rules.trace_contact.output[0],
        inference=rules.infer.output[0],
        code=code("draw_fig4.py"),
    output:
        **pictures("fig4"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig4.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig4.tsv"
    script:
        "../scripts/draw_fig4.py"


rule draw_fig6:
    input:
        inference=rules.infer.output[0],
        scales=rules.aggregate_scales.output[0],
        code=code("draw_fig6.py"),
    output:
        **pictures("fig6"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig6.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig6.tsv"
    script:
        "../scripts/draw_fig6.py"


rule draw_table1:
    input:
        topography=rules.aggregate_topography.output[0],
        published="resources/paper/table1.csv",
        code=code("draw_table1.py"),
    output:
        **pictures("table1"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_table1.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_table1.tsv"
    script:
        "../scripts/draw_table1.py"


rule figures:
    input:
        rules.draw_fig1.output,
        rules.draw_fig3.output,
        rules.draw_fig4.output,
        rules.draw_fig6.output,
        rules.draw_table1.output,
