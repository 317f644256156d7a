# Plasticity: the indents that contacts leave in the sphere, and how it enhances the range of adhesion.

INDENTED = STUDY["indent"]["surface"]


rule measure_indents:
    """Measure the indents that contacts on one surface leave in the sphere: indent.nc."""
    input:
        substrates=[FILES.stitched(INDENTED, scan) for scan in SELECTION.scans(INDENTED)],
        spheres=[FILES.stitched(SPHERE, scan) for scan in SELECTION.scans(SPHERE)],
        code=code_inputs("measure_indents.py"),
    output:
        PATTERNS.dataset("indent"),
    params:
        canonical=parameters(
            **named(INDENTED),
            scans=SELECTION.scans(INDENTED),
            sphere_scans=SELECTION.scans(SPHERE),
            preloads=STUDY["indent"]["preloads"],
            contact={key: STUDY["contact"][key] for key in ("hardness", "window", "count")},
            radius=STUDY["sphere"]["radius"],
        ),
    script:
        "../scripts/measure_indents.py"


rule compare_enhancement:
    """Find the short edges of plastic and rigid contact at two ranges: enhancement.nc."""
    input:
        masters=FILES.paths(PATTERNS.filtered, FILES.masters("enhancement")),
        code=code_inputs("compare_enhancement.py"),
    output:
        PATTERNS.dataset("enhancement"),
    params:
        canonical=parameters(
            masters=[row.surface for row in FILES.masters("enhancement")],
            realizations=STUDY["scaling"]["realizations"],
            tolerance=STUDY["scales"]["tolerance"],
            sampling=SAMPLING,
            **NAMED_SURFACES,
        ),
    script:
        "../scripts/compare_enhancement.py"
