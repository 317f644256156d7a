# Plasticity: the indents that contacts leave in the sphere, one by one and many at one place.

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


rule repeat_contact:
    """Measure how far the indents of many contacts at one place overlap: repeated_contact.nc."""
    input:
        substrates=[FILES.stitched(INDENTED, scan) for scan, _ in FILES.repeated_pairs],
        spheres=[FILES.stitched(SPHERE, sphere_scan) for _, sphere_scan in FILES.repeated_pairs],
        spectrum=FILES.spectrum(INDENTED),
        code=code_inputs("repeat_contact.py"),
    output:
        PATTERNS.dataset("repeated_contact"),
    log:
        PATTERNS.log("repeat_contact"),
    benchmark:
        PATTERNS.benchmark("repeat_contact")
    params:
        canonical=canonical(
            {
                "surface": INDENTED,
                "label": SELECTION.labels[INDENTED],
                "basis": SELECTION.basis[INDENTED],
                "pairs": FILES.repeated_pairs,
                "load": {
                    "preload": max(STUDY["indent"]["preloads"]),
                    "hardness": STUDY["contact"]["hardness"],
                },
                "contacts": STUDY["contact"]["count"] ** 2,
                "radius": STUDY["sphere"]["radius"],
                "size": max(STUDY["insight"]["sizes"]),
                "seed": STUDY["seed"],
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/repeat_contact.py"


rule compare_enhancement:
    """Find the short edges of plastic and rigid contact at two ranges: enhancement.nc."""
    input:
        masters=FILES.paths(PATTERNS.filtered, FILES.masters("enhancement")),
        code=code_inputs("compare_enhancement.py"),
    output:
        PATTERNS.dataset("enhancement"),
    log:
        PATTERNS.log("compare_enhancement"),
    benchmark:
        PATTERNS.benchmark("compare_enhancement")
    params:
        canonical=canonical(
            {
                "masters": [row.surface for row in FILES.masters("enhancement")],
                "realizations": STUDY["robustness"]["realizations"],
                "tolerance": STUDY["scales"]["tolerance"],
                **SAMPLING,
                **NAMED_SURFACES,
            }
        ),
    script:
        "../scripts/compare_enhancement.py"
