# Inference: range and work of adhesion, log-normal statistics.


rule infer:
    """Infer range and work of adhesion from computed and published forces: inference.nc."""
    input:
        adhesion=rules.aggregate_adhesion.output[0],
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("infer.py"),
    output:
        PATTERNS.dataset("inference"),
    log:
        PATTERNS.log("infer"),
    benchmark:
        PATTERNS.benchmark("infer")
    params:
        canonical=canonical(
            {
                **STUDY["inference"],
                "reference_surface": STUDY["reference_surface"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/infer.py"
