# Elastic contact: pressure at the preload, and pull-off beside that of rigid bodies.

from itertools import cycle


# One scan of the sphere for each scan of a substrate, in turn.
BESIDE = [
    (surface, scan, sphere_scan)
    for surface in SUBSTRATES
    for scan, sphere_scan in zip(scans_of(surface), cycle(scans_of(SPHERE)))
]


rule solve_elastic_contact:
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=f"{STORE}/stitched/{SPHERE}/scan-{{sphere_scan}}-sphere-{{radius}}.nc",
        published="resources/paper/parameters.csv",
        code=code("solve_elastic_contact.py"),
    output:
        f"{STORE}/elastic/{PAIR}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": STUDY["contact"],
                "elastic": STUDY["elastic"],
                "radius": STUDY["sphere"]["radius"],
                "seed": STUDY["seed"],
            }
        ),
    log:
        f"{STORE}/logs/solve_elastic_contact/{PAIR}.log",
    benchmark:
        f"{STORE}/benchmarks/solve_elastic_contact/{PAIR}.tsv"
    resources:
        mem_mb=1500,
    script:
        "../scripts/solve_elastic_contact.py"


rule aggregate_elastic:
    input:
        scans=[pair_file("elastic", *pair) for pair in BESIDE],
        code=code("aggregate_elastic.py"),
    output:
        f"{RESULTS}/elastic.nc",
    params:
        canonical=canonical(
            {"scans": [pair[:2] for pair in BESIDE], "labels": LABELS, "basis": BASIS}
        ),
    log:
        f"{RESULTS}/logs/aggregate_elastic.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_elastic.tsv"
    script:
        "../scripts/aggregate_elastic.py"


rule elastic:
    input:
        rules.aggregate_elastic.output,
