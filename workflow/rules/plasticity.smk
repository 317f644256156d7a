# Plasticity: the indents that contacts leave in the sphere.

INDENTED = STUDY["indent"]["surface"]


rule measure_indents:
    """Measure the indents that contacts on one surface leave in the sphere: indent.nc."""
    input:
        substrates=[FILES.stitched_path(INDENTED, scan) for scan in SELECTION.scans(INDENTED)],
        spheres=[FILES.stitched_path(SPHERE, scan) for scan in SELECTION.scans(SPHERE)],
        code=code_inputs("measure_indents.py"),
    output:
        PATTERNS.dataset("indent"),
    params:
        parameters=parameters(
            **named(INDENTED),
            scan_numbers=SELECTION.scans(INDENTED),
            sphere_scan_numbers=SELECTION.scans(SPHERE),
            preloads=STUDY["indent"]["preloads"],
            contact=CONTACT | {"preload": max(STUDY["indent"]["preloads"])},
        ),
    script:
        "../scripts/measure_indents.py"
