# How the edges of the band scale with the sphere, the range of adhesion and the contact area.

SCALING = INSIGHT["scaling"]
SCALED_SIDES = {
    "small": {"pixels": INSIGHT["small"]["pixels"], **SCALING["small"]},
    "large": SCALING["large"],
}


rule compute_scaled_pull_off:
    """Pull-off of both masters of a scan, filtered, over radii, ranges of adhesion and contact areas."""
    input:
        scan=PATTERNS.stitched_substrate,
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("compute_scaled_pull_off.py"),
    output:
        small=PATTERNS.small_scaled,
        large=PATTERNS.large_scaled,
    log:
        PATTERNS.log("compute_scaled_pull_off", PATTERNS.small_scaled),
    benchmark:
        PATTERNS.benchmark("compute_scaled_pull_off", PATTERNS.small_scaled)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "realization": int(w.scan),
                "seed": STUDY["seed"],
                "contact": {
                    "count": INSIGHT["count"],
                    **{key: STUDY["contact"][key] for key in ("window", "hardness")},
                },
                **{key: SCALING[key] for key in ("radii", "ranges", "preloads")},
                "sides": {
                    side: {"transition": STUDY["scales"][side]["transition"]} | SCALED_SIDES[side]
                    for side in SIDES
                },
            }
        ),
    script:
        "../scripts/compute_scaled_pull_off.py"


rule scale_edges:
    """How the edges of the band scale with R, rho and the contact area: scaling.nc."""
    input:
        masters=FILES.paths(PATTERNS.scaled, FILES.scaled_masters),
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        computed="resources/validation/prediction.csv",
        formulas="resources/validation/edges.csv",
        code=code_inputs("scale_edges.py"),
    output:
        PATTERNS.dataset("scaling"),
    log:
        PATTERNS.log("scale_edges"),
    benchmark:
        PATTERNS.benchmark("scale_edges")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "masters": FILES.scaled_masters,
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "tolerance": STUDY["scales"]["tolerance"],
                "seed": STUDY["seed"],
                **{key: STUDY["inference"][key] for key in ("samples", "confidence")},
                "sphere_radius": STUDY["sphere"]["radius"],
                "rho": STUDY["scales"]["range"],
                "area": STUDY["contact"]["preload"] / STUDY["contact"]["hardness"] * 1e18,
            }
        ),
    script:
        "../scripts/scale_edges.py"
