# Whether another law of attraction would give similar results.


rule compute_law_forces:
    """Compute the forces of a scan and its masters at the ranges that laws are mixtures of."""
    input:
        scan=PATTERNS.stitched_substrate,
        spectrum=lambda w: FILES.spectrum(w.surface),
        sphere=FILES.first_sphere,
        code=code_inputs("compute_law_forces.py"),
    output:
        scan=PATTERNS.law_scan,
        small=PATTERNS.law_small,
        large=PATTERNS.law_large,
    log:
        PATTERNS.log("compute_law_forces", PATTERNS.law_scan),
    benchmark:
        PATTERNS.benchmark("compute_law_forces", PATTERNS.law_scan)
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": STUDY["contact"] | {"count": INSIGHT["count"]},
                "radius": STUDY["sphere"]["radius"],
                "window": INSIGHT["window"],
                "anchor": STUDY["scales"]["range"],
                "scales": {
                    side: {"transition": STUDY["scales"][side]["transition"]} | INSIGHT[side]
                    for side in SIDES
                },
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/compute_law_forces.py"


rule compare_laws:
    """Fit every law of attraction, and find its critical band: laws.nc."""
    input:
        scans=FILES.paths(PATTERNS.law_scan, FILES.realized_scans),
        small=FILES.paths(PATTERNS.law_small, FILES.realized_scans),
        large=FILES.paths(PATTERNS.law_large, FILES.realized_scans),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("compare_laws.py"),
    output:
        PATTERNS.dataset("laws"),
    log:
        PATTERNS.log("compare_laws"),
    benchmark:
        PATTERNS.benchmark("compare_laws")
    params:
        canonical=canonical(
            {
                "scans": FILES.realized_scans,
                **NAMED_SURFACES,
                "reference_surface": STUDY["reference_surface"],
                "contacts": INSIGHT["count"] ** 2,
                "tolerance": STUDY["scales"]["tolerance"],
                **SAMPLING,
            }
        ),
    script:
        "../scripts/compare_laws.py"
