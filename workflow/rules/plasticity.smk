# Plasticity: the indents that contacts leave in the sphere.

INDENTED = STUDY["indent"]["surface"]
INDENTS = [
    (scan, sphere_scan) for scan in scans_of(INDENTED) for sphere_scan in scans_of(SPHERE)
]


rule measure_indents:
    input:
        substrates=[stitched(INDENTED, scan) for scan, _ in INDENTS],
        spheres=[stitched(SPHERE, sphere_scan) for _, sphere_scan in INDENTS],
        published="resources/paper/parameters.csv",
        code=code("measure_indents.py"),
    output:
        f"{RESULTS}/indent.nc",
    params:
        canonical=canonical(
            {
                "surface": INDENTED,
                "label": LABELS[INDENTED],
                "basis": BASIS[INDENTED],
                "pairs": INDENTS,
                "preloads": STUDY["indent"]["preloads"],
                "contact": {key: STUDY["contact"][key] for key in ("hardness", "window", "count")},
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    log:
        f"{RESULTS}/logs/measure_indents.log",
    benchmark:
        f"{RESULTS}/benchmarks/measure_indents.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/measure_indents.py"


rule plasticity:
    input:
        rules.measure_indents.output,
