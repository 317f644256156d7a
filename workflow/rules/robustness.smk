# Robustness: the headline numbers under other choices, at the size of the sets.

SIZE = STUDY["sets"]


rule average_pull_off:
    """Compute the mean forces of all scans of a surface on a smooth sphere or on one of the rough."""
    input:
        substrates=lambda w: [
            FILES.stitched(w.surface, scan, w.variant) for scan in SELECTION.scans(w.surface)
        ],
        sphere=lambda w: FILES.first_sphere if w.probe == "rough" else [],
        code=code_inputs("average_pull_off.py"),
    output:
        PATTERNS.mean_forces,
    log:
        PATTERNS.log("average_pull_off", PATTERNS.mean_forces),
    benchmark:
        PATTERNS.benchmark("average_pull_off", PATTERNS.mean_forces)
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scans": SELECTION.scans(w.surface),
                "sphere_scan": SELECTION.sphere_scans[0],
                "radius": STUDY["sphere"]["radius"],
                "loads": FILES.mean_loads(w.probe),
                "ranges": RANGES,
                "array": {
                    "window": STUDY["contact"]["window"],
                    # Of the smooth sphere the forces are set beside those of the study.
                    "count": (SIZE if w.probe == "rough" else STUDY["contact"])["count"],
                },
            }
        ),
    script:
        "../scripts/average_pull_off.py"


rule aggregate_robustness:
    """Infer adhesion and the critical band again under every variant: robustness.nc."""
    input:
        adhesion=FILES.paths(PATTERNS.mean_forces, FILES.varied_forces),
        scales=FILES.paths(PATTERNS.filtered, FILES.varied_masters("robustness")),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("aggregate_robustness.py"),
    output:
        PATTERNS.dataset("robustness"),
    log:
        PATTERNS.log("aggregate_robustness"),
    benchmark:
        PATTERNS.benchmark("aggregate_robustness")
    params:
        canonical=canonical(
            {
                **STUDY["inference"],
                "variants": [variant.parameters() for variant in FILES.variants],
                "surfaces": FILES.varied_surfaces,
                "masters": [
                    [row.surface, row.variant, row.probe]
                    for row in FILES.varied_masters("robustness")
                ],
                "realizations": STUDY["robustness"]["realizations"],
                "substrates": SELECTION.substrates,
                "probe": FILES.probe,
                **{f"pixels_{side}": SIZE[side]["pixels"] for side in SIDES},
                "contacts_per_side": SIZE["count"],
                "tolerance": STUDY["scales"]["tolerance"],
                "range": STUDY["scales"]["range"],
                "reference_surface": STUDY["reference_surface"],
                "seed": STUDY["seed"],
                "sphere_radius": STUDY["sphere"]["radius"],
                "basis": SELECTION.basis,
            }
        ),
    script:
        "../scripts/aggregate_robustness.py"
