# Plasticity: the indents that contacts leave in the sphere, and short edges without plasticity.

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


rule compare_short_edges:
    """Compare the short edges of plastic and rigid contact at two ranges: enhancement.nc."""
    input:
        masters=FILES.paths(PATTERNS.master_forces, CHUNKS.filtered_masters("enhancement")),
        code=code_inputs("compare_short_edges.py"),
    output:
        PATTERNS.dataset("enhancement"),
    params:
        parameters=parameters(
            surfaces=[row.surface for row in CHUNKS.filtered_masters("enhancement")],
            realizations=STUDY["exponents"]["realizations"],
            tolerance=STUDY["scales"]["tolerance"],
            sampling=SAMPLING,
            **NAMED_SURFACES,
        ),
    script:
        "../scripts/compare_short_edges.py"
