# Report: the pages that are no figures. `snakemake --report` gathers them with the figures.


def page(name):
    return report(
        f"{RESULTS}/report/{name}.html",
        caption=f"../report/{name}.rst",
        category="8. Verdicts, departures, parameters",
    )


rule describe_study:
    input:
        claims=rules.evaluate_claims.output[0],
        readme="README.md",
        environment="environment.txt",
        code=code("describe_study.py"),
    output:
        claims=page("claims"),
        departures=page("departures"),
        parameters=page("parameters"),
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
