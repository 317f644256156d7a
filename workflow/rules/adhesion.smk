# Adhesion: rigid and plastic pull-off for every pair of substrate and sphere scan.


rule compute_pull_off:
    """Compute rigid and plastic pull-off of one pair of scans, at every contact and range."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=lambda w: FILES.sphere(int(w.sphere_scan)),
        code=code_inputs("compute_pull_off.py"),
    output:
        PATTERNS.pull_off,
    log:
        PATTERNS.log("compute_pull_off", PATTERNS.pull_off),
    benchmark:
        PATTERNS.benchmark("compute_pull_off", PATTERNS.pull_off)
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "contact": STUDY["contact"],
                "ranges": RANGES,
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    script:
        "../scripts/compute_pull_off.py"


rule measure_window_change:
    """Measure how much a wider window changes the forces of one scan, at the reference range."""
    input:
        substrate=PATTERNS.stitched_substrate,
        spheres=FILES.stitched_spheres,
        code=code_inputs("measure_window_change.py"),
    output:
        PATTERNS.window_change,
    log:
        PATTERNS.log("measure_window_change", PATTERNS.window_change),
    benchmark:
        PATTERNS.benchmark("measure_window_change", PATTERNS.window_change)
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "contact": STUDY["contact"],
                "reference_range": STUDY["scales"]["range"],
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    script:
        "../scripts/measure_window_change.py"


rule aggregate_adhesion:
    """Gather the pull-off forces of all pairs of scans: adhesion.nc."""
    input:
        pairs=FILES.of_pairs(PATTERNS.pull_off, FILES.pairs),
        window_changes=FILES.window_changes,
        code=code_inputs("aggregate_adhesion.py"),
    output:
        PATTERNS.dataset("adhesion"),
    log:
        PATTERNS.log("aggregate_adhesion"),
    benchmark:
        PATTERNS.benchmark("aggregate_adhesion")
    params:
        canonical=canonical(
            {
                "pairs": [[pair.surface, pair.scan, pair.sphere_scan] for pair in FILES.pairs],
                "scans": FILES.substrate_scans,
                "labels": SELECTION.labels,
                "basis": SELECTION.basis,
                "sphere_radius": STUDY["sphere"]["radius"],
                "reference_rho": STUDY["scales"]["range"],
            }
        ),
    script:
        "../scripts/aggregate_adhesion.py"


rule adhesion:
    """Make the pull-off forces of all pairs, and the traced contact of the paper."""
    input:
        rules.aggregate_adhesion.output,
        PATTERNS.dataset("contact") if COMPARED else [],
