# Robustness: the headline numbers under other choices, at the size of the sets.

SIZE = STUDY["sets"]
PROBE = FILES.variants[0].probe


rule vary_adhesion:
    """Compute the mean forces of the scans of one variant of a surface, on one of the sphere."""
    input:
        substrates=lambda w: [
            FILES.stitched(w.surface, scan, w.variant) for scan in SELECTION.scans(w.surface)
        ],
        sphere=FILES.first_sphere,
        code=code_inputs("vary_adhesion.py"),
    output:
        PATTERNS.varied_adhesion,
    log:
        PATTERNS.log("vary_adhesion", PATTERNS.varied_adhesion),
    benchmark:
        PATTERNS.benchmark("vary_adhesion", PATTERNS.varied_adhesion)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scans": SELECTION.scans(w.surface),
                "sphere_scan": SELECTION.sphere_scans[0],
                "loads": FILES.loads(PROBE),
                "array": {"count": SIZE["count"], "window": STUDY["contact"]["window"]},
                "ranges": RANGES,
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    script:
        "../scripts/vary_adhesion.py"


for surfaces, variants in FILES.varied_together.items():

    rule:
        """Compute the forces of all masters of one realization, filtered, at every load."""
        name:
            f"vary_scales_{variants[0]}"
        input:
            scans=lambda w, surfaces=surfaces: [
                FILES.stitched_of_set_realization(surface, int(w.realization), w.variant)
                for surface in surfaces
            ],
            spectra=lambda w, surfaces=surfaces: [
                FILES.spectrum(surface, w.variant) for surface in surfaces
            ],
            sphere=lambda w: FILES.first_sphere if w.probe == "rough" else [],
            code=code_inputs("vary_scales.py"),
        output:
            expand(PATTERNS.varied_scales, surface=surfaces, side=SIDES, allow_missing=True),
        log:
            PATTERNS.log("vary_scales", PATTERNS.varied_realization),
        benchmark:
            PATTERNS.benchmark("vary_scales", PATTERNS.varied_realization)
        wildcard_constraints:
            variant=any_of(variants),
        resources:
            mem_mb=2000,
        params:
            canonical=lambda w, surfaces=surfaces: canonical(
                {
                    "surfaces": surfaces,
                    "realization": int(w.realization),
                    "seed": STUDY["seed"],
                    "sides": {side: STUDY["scales"][side] | SIZE[side] for side in SIDES},
                    "rho": STUDY["scales"]["range"],
                    "loads": FILES.loads(w.probe),
                    "array": {"count": SIZE["count"], "window": STUDY["contact"]["window"]},
                    "radius": STUDY["sphere"]["radius"],
                }
            ),
        script:
            "../scripts/vary_scales.py"


rule aggregate_robustness:
    """Infer adhesion and the critical band again under every variant: robustness.nc."""
    input:
        adhesion=[
            FILES.path(PATTERNS.varied_adhesion, surface, variant=variant)
            for surface, variant in FILES.varied_surfaces
        ],
        scales=FILES.paths(PATTERNS.varied_scales, FILES.varied_masters),
        published_pull_off=PUBLISHED["published_pull_off"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("aggregate_robustness.py"),
    output:
        PATTERNS.dataset("robustness"),
    log:
        PATTERNS.log("aggregate_robustness"),
    benchmark:
        PATTERNS.benchmark("aggregate_robustness")
    resources:
        mem_mb=2000,
    params:
        canonical=canonical(
            {
                **STUDY["inference"],
                "variants": [variant.parameters() for variant in FILES.variants],
                "surfaces": FILES.varied_surfaces,
                "masters": FILES.varied_masters,
                "substrates": SELECTION.substrates,
                "probe": PROBE,
                **{f"pixels_{side}": SIZE[side]["pixels"] for side in SIDES},
                "count": SIZE["count"],
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


rule robustness:
    """Make the headline numbers under other choices."""
    input:
        rules.aggregate_robustness.output,
