# Figures: drawn from the aggregated datasets alone, by the study and by redraw.smk.

# Chapter of the report and name of each figure, in the order of the paper.
CHAPTERS = {
    "fig1": ("1. Surfaces", "Fig. 1: height maps"),
    "table1": ("1. Surfaces", "Table 1: roughness"),
    "fig_elastic": ("2. Contact", "elastic contact"),
    "fig5": ("2. Contact", "Fig. 5: indents"),
    "fig3": ("3. Adhesion", "Fig. 3: distributions of the pull-off force"),
    "fig4": ("3. Adhesion", "Fig. 4: range and work of adhesion"),
    "fig_classical": ("4. Classical models", "classical models"),
    "fig_asperities": ("5. Asperities", "asperities that carry the force"),
    "fig6": ("6. Scales", "Fig. 6: scales of roughness"),
    "fig_robustness": ("7. Robustness", "other choices"),
}


def pictures(name):
    """A figure's files; the picture goes into the report with its caption."""
    folder = f"{RESULTS}/figures/{name}"
    chapter, title = CHAPTERS[name]
    return {
        "pdf": f"{folder}.pdf",
        "png": report(
            f"{folder}.png",
            caption=f"../report/{name}.rst",
            category=chapter,
            labels={"figure": title},
        ),
        "csv": f"{folder}.csv",
        "record": f"{RESULTS}/provenance/{name}.json",
    }


rule draw_fig1:
    input:
        topography=f"{RESULTS}/topography.nc",
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


rule draw_table1:
    input:
        topography=f"{RESULTS}/topography.nc",
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


rule draw_fig_elastic:
    input:
        elastic=f"{RESULTS}/elastic.nc",
        code=code("draw_fig_elastic.py"),
    output:
        **pictures("fig_elastic"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig_elastic.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig_elastic.tsv"
    script:
        "../scripts/draw_fig_elastic.py"


rule draw_fig5:
    input:
        indent=f"{RESULTS}/indent.nc",
        code=code("draw_fig5.py"),
    output:
        **pictures("fig5"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig5.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig5.tsv"
    script:
        "../scripts/draw_fig5.py"


rule draw_fig3:
    input:
        adhesion=f"{RESULTS}/adhesion.nc",
        inference=f"{RESULTS}/inference.nc",
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
        contact=f"{RESULTS}/contact.nc",
        inference=f"{RESULTS}/inference.nc",
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


rule draw_fig_classical:
    input:
        classical=f"{RESULTS}/classical.nc",
        code=code("draw_fig_classical.py"),
    output:
        **pictures("fig_classical"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig_classical.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig_classical.tsv"
    script:
        "../scripts/draw_fig_classical.py"


rule draw_fig_asperities:
    input:
        asperities=f"{RESULTS}/asperities.nc",
        inference=f"{RESULTS}/inference.nc",
        code=code("draw_fig_asperities.py"),
    output:
        **pictures("fig_asperities"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig_asperities.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig_asperities.tsv"
    script:
        "../scripts/draw_fig_asperities.py"


rule draw_fig6:
    input:
        inference=f"{RESULTS}/inference.nc",
        scales=f"{RESULTS}/scales.nc",
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


rule draw_fig_robustness:
    input:
        robustness=f"{RESULTS}/robustness.nc",
        inference=f"{RESULTS}/inference.nc",
        code=code("draw_fig_robustness.py"),
    output:
        **pictures("fig_robustness"),
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/draw_fig_robustness.log",
    benchmark:
        f"{RESULTS}/benchmarks/draw_fig_robustness.tsv"
    script:
        "../scripts/draw_fig_robustness.py"


rule figures:
    input:
        rules.draw_fig1.output,
        rules.draw_table1.output,
        rules.draw_fig_elastic.output,
        rules.draw_fig5.output,
        rules.draw_fig3.output,
        rules.draw_fig4.output,
        rules.draw_fig_classical.output,
        rules.draw_fig_asperities.output,
        rules.draw_fig6.output,
        rules.draw_fig_robustness.output,
