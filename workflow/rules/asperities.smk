# Asperities: the patches that carry the force of a contact.


rule find_asperities:
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=f"{STORE}/stitched/{SPHERE}/scan-{{sphere_scan}}-sphere-{{radius}}.nc",
        code=code("find_asperities.py"),
    output:
        f"{STORE}/asperities/{PAIR}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": STUDY["contact"],
                "asperities": STUDY["asperities"],
                "radius": STUDY["sphere"]["radius"],
                "seed": STUDY["seed"],
            }
        ),
    log:
        f"{STORE}/logs/find_asperities/{PAIR}.log",
    benchmark:
        f"{STORE}/benchmarks/find_asperities/{PAIR}.tsv"
    resources:
        mem_mb=1500,
    script:
        "../scripts/find_asperities.py"


rule aggregate_asperities:
    input:
        scans=[pair_file("asperities", *pair) for pair in BESIDE],
        code=code("aggregate_asperities.py"),
    output:
        f"{RESULTS}/asperities.nc",
    params:
        canonical=canonical(
            {"scans": [pair[:2] for pair in BESIDE], "labels": LABELS, "basis": BASIS}
        ),
    log:
        f"{RESULTS}/logs/aggregate_asperities.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_asperities.tsv"
    script:
        "../scripts/aggregate_asperities.py"


rule asperities:
    input:
        rules.aggregate_asperities.output,
