# Elastic contact: pressure at the preload, and pull-off beside that of rigid bodies.


def sphere_beside(w):
    """One stitched scan of the sphere for each scan of a substrate, in turn."""
    scans, place = scans_of(SPHERE), scans_of(w.surface).index(int(w.scan))
    return stitched(SPHERE, scans[place % len(scans)])


rule solve_elastic_contact:
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=sphere_beside,
        published="resources/paper/parameters.csv",
        code=code("solve_elastic_contact.py"),
    output:
        f"{STORE}/elastic/{{radius}}/{{load}}/{{surface}}/scan-{{scan}}.nc",
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
        f"{STORE}/logs/solve_elastic_contact/{{radius}}-{{load}}-{{surface}}-{{scan}}.log",
    benchmark:
        f"{STORE}/benchmarks/solve_elastic_contact/{{radius}}-{{load}}-{{surface}}-{{scan}}.tsv"
    resources:
        mem_mb=1500,
    script:
        "../scripts/solve_elastic_contact.py"


SUBSTRATE_SCANS = [(surface, scan) for surface in SUBSTRATES for scan in scans_of(surface)]


rule aggregate_elastic:
    input:
        scans=[
            f"{STORE}/elastic/{RADIUS}/{LOAD}/{surface}/scan-{scan}.nc"
            for surface, scan in SUBSTRATE_SCANS
        ],
        code=code("aggregate_elastic.py"),
    output:
        f"{RESULTS}/elastic.nc",
    params:
        canonical=canonical({"scans": SUBSTRATE_SCANS, "labels": LABELS, "basis": BASIS}),
    log:
        f"{RESULTS}/logs/aggregate_elastic.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_elastic.tsv"
    script:
        "../scripts/aggregate_elastic.py"


rule elastic:
    input:
        rules.aggregate_elastic.output,
