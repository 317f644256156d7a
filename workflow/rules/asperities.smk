# Asperities: the patches that carry the force of a contact.


rule find_asperities:
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=sphere_beside,
        code=code("find_asperities.py"),
    output:
        f"{STORE}/asperities/{{radius}}/{{load}}/{{surface}}/scan-{{scan}}.nc",
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
        f"{STORE}/logs/find_asperities/{{radius}}-{{load}}-{{surface}}-{{scan}}.log",
    benchmark:
        f"{STORE}/benchmarks/find_asperities/{{radius}}-{{load}}-{{surface}}-{{scan}}.tsv"
    resources:
        mem_mb=1500,
    script:
        "../scripts/find_asperities.py"


rule aggregate_asperities:
    input:
        scans=[
            f"{STORE}/asperities/{RADIUS}/{LOAD}/{surface}/scan-{scan}.nc"
            for surface, scan in SUBSTRATE_SCANS
        ],
        code=code("aggregate_asperities.py"),
    output:
        f"{RESULTS}/asperities.nc",
    params:
        canonical=canonical({"scans": SUBSTRATE_SCANS, "labels": LABELS, "basis": BASIS}),
    log:
        f"{RESULTS}/logs/aggregate_asperities.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_asperities.tsv"
    script:
        "../scripts/aggregate_asperities.py"


rule asperities:
    input:
        rules.aggregate_asperities.output,
