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
            scans=SELECTION.scans(INDENTED),
            sphere_scans=SELECTION.scans(SPHERE),
            preloads=STUDY["indent"]["preloads"],
            contact={
                key: STUDY["contact"][key] for key in ("hardness", "window", "contacts_per_row")
            },
            radius=STUDY["sphere"]["radius"],
        ),
    script:
        "../scripts/measure_indents.py"
