# Claims: each statement of the paper beside what was computed.


rule evaluate_claims:
    input:
        topography=rules.aggregate_topography.output[0],
        adhesion=rules.aggregate_adhesion.output[0],
        scales=rules.aggregate_scales.output[0],
        inference=rules.infer.output[0],
        elastic=rules.aggregate_elastic.output[0],
        indent=rules.measure_indents.output[0],
        asperities=rules.aggregate_asperities.output[0],
        classical=rules.apply_classical_models.output[0],
        claims="resources/paper/claims.csv",
        code=code("evaluate_claims.py"),
    output:
        claims=f"{RESULTS}/claims.csv",
        record=f"{RESULTS}/provenance/claims.json",
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
