# Claims: each statement of the paper beside what was computed.


rule evaluate_claims:
    input:
        topography=rules.aggregate_topography.output[0],
        adhesion=rules.aggregate_adhesion.output[0],
        scales=rules.aggregate_scales.output[0],
        inference=rules.infer.output[0],
        claims="resources/paper/claims.csv",
        code=code("evaluate_claims.py"),
    output:
        f"{RESULTS}/claims.csv",
    params:
        canonical=canonical({}),
    log:
        f"{RESULTS}/logs/evaluate_claims.log",
    benchmark:
        f"{RESULTS}/benchmarks/evaluate_claims.tsv"
    script:
        "../scripts/evaluate_claims.py"


rule claims:
    input:
        rules.evaluate_claims.output,
