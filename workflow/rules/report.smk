# Report: the pages that are no figures. `snakemake --report` gathers them with the figures.


def page(name, chapter, title):
    return report(
        f"{RESULTS}/report/{name}.html",
        caption=f"../report/{name}.rst",
        category=chapter,
        labels={"page": title},
    )


rule describe_study:
    input:
        claims=f"{RESULTS}/claims.csv",
        readme="README.md",
        environment="environment.txt",
        code=code("describe_study.py"),
    output:
        claims=page("claims", "8. Verdicts", "verdicts on the paper's statements"),
        departures=page("departures", "9. Departures, parameters", "where the study departs from the paper"),
        parameters=page("parameters", "9. Departures, parameters", "parameters and versions"),
        record=f"{RESULTS}/provenance/pages.json",
    params:
        canonical=canonical(config),
    log:
        f"{RESULTS}/logs/describe_study.log",
    benchmark:
        f"{RESULTS}/benchmarks/describe_study.tsv"
    script:
        "../scripts/describe_study.py"


rule pages:
    input:
        rules.describe_study.output,
