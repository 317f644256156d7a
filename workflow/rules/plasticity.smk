# Plasticity: the indents that contacts leave in the sphere.

INDENTED = STUDY["indent"]["surface"]


rule measure_indents:
    """Measure the indents that contacts on one surface leave in the sphere: indent.nc."""
    input:
        substrates=[FILES.stitched(INDENTED, scan) for scan, _ in FILES.indent_pairs],
        spheres=[FILES.stitched(SPHERE, sphere_scan) for _, sphere_scan in FILES.indent_pairs],
        code=code_inputs("measure_indents.py"),
    output:
        PATTERNS.dataset("indent"),
    log:
        PATTERNS.log("measure_indents"),
    benchmark:
        PATTERNS.benchmark("measure_indents")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "surface": INDENTED,
                "label": SELECTION.labels[INDENTED],
                "basis": SELECTION.basis[INDENTED],
                "pairs": FILES.indent_pairs,
                "preloads": STUDY["indent"]["preloads"],
                "contact": {key: STUDY["contact"][key] for key in ("hardness", "window", "count")},
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    script:
        "../scripts/measure_indents.py"


rule plasticity:
    """Make the indents in the sphere."""
    input:
        rules.measure_indents.output,
