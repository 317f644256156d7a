# Inference: range and work of adhesion, log-normal statistics, the critical band.


rule infer:
    input:
        adhesion=rules.aggregate_adhesion.output[0],
        scales=rules.aggregate_scales.output[0],
        pull_off="resources/paper/pull_off.csv",
        published="resources/paper/parameters.csv",
        code=code("infer.py"),
    output:
        f"{RESULTS}/inference.nc",
    params:
        canonical=canonical(
            {
                **STUDY["inference"],
                "tolerance": STUDY["scales"]["tolerance"],
                "reference_surface": STUDY["reference_surface"],
                "seed": STUDY["seed"],
            }
        ),
    log:
        f"{RESULTS}/logs/infer.log",
    benchmark:
        f"{RESULTS}/benchmarks/infer.tsv"
    resources:
        mem_mb=2000,
    script:
        "../scripts/infer.py"
