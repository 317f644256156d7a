# Classical models: effective work of adhesion, models of rough adhesion.


rule apply_classical_models:
    input:
        inference=rules.infer.output[0],
        table1="resources/paper/table1.csv",
        pull_off="resources/paper/pull_off.csv",
        parameters="resources/paper/parameters.csv",
        code=code("apply_classical_models.py"),
    output:
        f"{RESULTS}/classical.nc",
    params:
        canonical=canonical(
            {
                "seed": STUDY["seed"],
                "draws": STUDY["inference"]["bootstrap_samples"],
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    log:
        f"{RESULTS}/logs/apply_classical_models.log",
    benchmark:
        f"{RESULTS}/benchmarks/apply_classical_models.tsv"
    script:
        "../scripts/apply_classical_models.py"


rule classical:
    input:
        rules.apply_classical_models.output,
