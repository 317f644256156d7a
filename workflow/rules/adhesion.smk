# Adhesion: rigid and plastic pull-off for every pair of substrate and sphere scan.


rule compute_pull_off:
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=f"{STORE}/stitched/{SPHERE}/scan-{{sphere_scan}}-sphere-{{radius}}.nc",
        code=code("compute_pull_off.py"),
    output:
        f"{STORE}/pull_off/{PAIR}.nc",
    params:
        canonical=canonical(
            {
                "contact": STUDY["contact"],
                "ranges": STUDY["adhesion"]["ranges"],
                "reference_range": STUDY["scales"]["range"],
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    log:
        f"{STORE}/logs/compute_pull_off/{PAIR}.log",
    benchmark:
        f"{STORE}/benchmarks/compute_pull_off/{PAIR}.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/compute_pull_off.py"


PAIRS = pairs_of(SUBSTRATES)


rule aggregate_adhesion:
    input:
        pairs=[pair_file("pull_off", *pair) for pair in PAIRS],
        code=code("aggregate_adhesion.py"),
    output:
        f"{RESULTS}/adhesion.nc",
    params:
        canonical=canonical(
            {
                "pairs": PAIRS,
                "labels": LABELS,
                "basis": BASIS,
                "sphere_radius": STUDY["sphere"]["radius"],
                "reference_rho": STUDY["scales"]["range"],
            }
        ),
    log:
        f"{RESULTS}/logs/aggregate_adhesion.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_adhesion.tsv"
    script:
        "../scripts/aggregate_adhesion.py"


TRACED = STUDY["adhesion"]["traced_contact"]


rule trace_contact:
    # gap, adhesive pressure and force-separation curve of one contact
    input:
        substrate=stitched(TRACED["surface"], TRACED["scan"]),
        sphere=stitched(SPHERE, TRACED["sphere_scan"]),
        published="resources/paper/parameters.csv",
        code=code("trace_contact.py"),
    output:
        f"{RESULTS}/contact.nc",
    params:
        canonical=canonical(
            {
                **TRACED,
                "contacts": STUDY["contact"],
                "radius": STUDY["sphere"]["radius"],
                "label": LABELS[TRACED["surface"]],
                "basis": BASIS[TRACED["surface"]],
            }
        ),
    log:
        f"{RESULTS}/logs/trace_contact.log",
    benchmark:
        f"{RESULTS}/benchmarks/trace_contact.tsv"
    script:
        "../scripts/trace_contact.py"


rule adhesion:
    input:
        rules.aggregate_adhesion.output,
        rules.trace_contact.output,
