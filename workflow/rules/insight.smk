# Insight: what decides the critical band, and how far the method can be trusted.

from hardcontact.study.insight_files import InsightFiles

INSIGHT = STUDY["insight"]
SCALING, SCAN_SIZES = INSIGHT["scaling"], INSIGHT["scan_sizes"]
INSIGHT_FILES = InsightFiles(config, SELECTION, PATTERNS)
INSIGHT_RANGES = sorted({*INSIGHT["ranges"], STUDY["scales"]["range"]})
WINDOW_CONTACTS = {
    **{key: SCAN_SIZES[key] for key in ("sizes", "count")},
    "radius": STUDY["sphere"]["radius"],
    "window": STUDY["contact"]["window"],
    "load": {
        "name": "study",
        **{key: STUDY["contact"][key] for key in ("preload", "hardness")},
    },
}
SIDES = ("small", "large")
NAMED_SURFACES = {"labels": SELECTION.labels, "basis": SELECTION.basis}


rule compare_closed_form:
    """Compare the closed form of the pull-off force with random surfaces: closed_form.nc."""
    input:
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("compare_closed_form.py"),
    output:
        PATTERNS.dataset("closed_form"),
    log:
        PATTERNS.log("compare_closed_form"),
    benchmark:
        PATTERNS.benchmark("compare_closed_form")
    resources:
        mem_mb=1500,
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "trial": {
                    **{key: INSIGHT[key] for key in ("pixels", "realizations", "sizes")},
                    "ranges": INSIGHT_RANGES,
                    "cutoffs": {side: STUDY["scales"][side]["cutoffs"] for side in SIDES},
                    "array": {
                        "window": STUDY["contact"]["window"],
                        "count": INSIGHT["count"],
                    },
                    "load": {key: STUDY["contact"][key] for key in ("preload", "hardness")},
                    "radius": STUDY["sphere"]["radius"],
                    "rho": STUDY["scales"]["range"],
                    "tolerance": STUDY["scales"]["tolerance"],
                    "confidence": STUDY["inference"]["confidence"],
                    "seed": STUDY["seed"],
                },
            }
        ),
    script:
        "../scripts/compare_closed_form.py"


rule compute_law_forces:
    """Compute the forces of a scan and its masters at the ranges that laws are mixtures of."""
    input:
        scan=PATTERNS.stitched_substrate,
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
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
    resources:
        mem_mb=2000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": STUDY["contact"] | {"count": INSIGHT["count"]},
                "radius": STUDY["sphere"]["radius"],
                "reach": INSIGHT["reach"],
                # The step gives the pressure of every law to 3e-4, these ends that of its tail.
                "ranges": {
                    "anchor": STUDY["scales"]["range"],
                    "step": 0.6,
                    "low": 0.02,
                    "high": 1e5,
                },
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
        scans=INSIGHT_FILES.of_scans(PATTERNS.law_scan),
        small=INSIGHT_FILES.of_scans(PATTERNS.law_small),
        large=INSIGHT_FILES.of_scans(PATTERNS.law_large),
        published_pull_off=PUBLISHED["published_pull_off"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("compare_laws.py"),
    output:
        PATTERNS.dataset("laws"),
    log:
        PATTERNS.log("compare_laws"),
    benchmark:
        PATTERNS.benchmark("compare_laws")
    resources:
        mem_mb=2000,
    params:
        canonical=canonical(
            {
                "scans": INSIGHT_FILES.scans,
                **NAMED_SURFACES,
                "reference_surface": STUDY["reference_surface"],
                "spacing": INSIGHT["spacing"],
                "tolerance": STUDY["scales"]["tolerance"],
                "seed": STUDY["seed"],
                **{key: STUDY["inference"][key] for key in ("samples", "confidence")},
            }
        ),
    script:
        "../scripts/compare_laws.py"


rule map_forces:
    """Map the rigid pull-off force on every scan: maps.nc."""
    input:
        substrates=[FILES.stitched(*one) for one in FILES.substrate_scans],
        code=code_inputs("map_forces.py"),
    output:
        PATTERNS.dataset("maps"),
    log:
        PATTERNS.log("map_forces"),
    benchmark:
        PATTERNS.benchmark("map_forces")
    resources:
        mem_mb=1500,
    params:
        canonical=canonical(
            {
                "scans": FILES.substrate_scans,
                **NAMED_SURFACES,
                "settings": {
                    "radius": STUDY["sphere"]["radius"],
                    "contact": {key: STUDY["contact"][key] for key in ("window", "count")},
                    "ranges": INSIGHT_RANGES,
                    "reference_rho": STUDY["scales"]["range"],
                    "tolerance": INSIGHT["mean_error"],
                    "confidence": STUDY["inference"]["confidence"],
                },
            }
        ),
    script:
        "../scripts/map_forces.py"


rule repeat_contact:
    """Press one place of the sphere onto all places of a scan, one after the other."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=PATTERNS.stitched_sphere,
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("repeat_contact.py"),
    output:
        PATTERNS.repeated_contact,
    log:
        PATTERNS.log("repeat_contact", PATTERNS.repeated_contact),
    benchmark:
        PATTERNS.benchmark("repeat_contact", PATTERNS.repeated_contact)
    resources:
        mem_mb=1500,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": {
                    **{key: STUDY["contact"][key] for key in ("hardness", "window", "count")},
                    "preload": INSIGHT_FILES.repeated_loads[w.load]["preload"],
                },
                "radius": STUDY["sphere"]["radius"],
                "orders": INSIGHT["orders"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/repeat_contact.py"


rule aggregate_repeated_contact:
    """Gather repeated contact of all scans: repeated_contact.nc."""
    input:
        pairs=list(INSIGHT_FILES.repeated),
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("aggregate_repeated_contact.py"),
    output:
        PATTERNS.dataset("repeated_contact"),
    log:
        PATTERNS.log("aggregate_repeated_contact"),
    benchmark:
        PATTERNS.benchmark("aggregate_repeated_contact")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "pairs": list(INSIGHT_FILES.repeated.values()),
                **NAMED_SURFACES,
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/aggregate_repeated_contact.py"


rule estimate_elastic_limit:
    """Estimate which contacts of one scan yield, and the force of those that do not."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=PATTERNS.stitched_sphere,
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("estimate_elastic_limit.py"),
    output:
        PATTERNS.elastic_limit,
    log:
        PATTERNS.log("estimate_elastic_limit", PATTERNS.elastic_limit),
    benchmark:
        PATTERNS.benchmark("estimate_elastic_limit", PATTERNS.elastic_limit)
    resources:
        mem_mb=1500,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": STUDY["contact"],
                "elastic": {key: STUDY["elastic"][key] for key in ("sphere", "substrate")},
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    script:
        "../scripts/estimate_elastic_limit.py"


rule aggregate_elastic_limit:
    """Gather which contacts yield, and the force of the others: elastic_limit.nc."""
    input:
        scans=FILES.of_pairs(PATTERNS.elastic_limit, FILES.pairs_in_turn),
        elastic=PATTERNS.dataset("elastic"),
        code=code_inputs("aggregate_elastic_limit.py"),
    output:
        PATTERNS.dataset("elastic_limit"),
    log:
        PATTERNS.log("aggregate_elastic_limit"),
    benchmark:
        PATTERNS.benchmark("aggregate_elastic_limit")
    params:
        canonical=canonical(
            {
                "scans": FILES.substrate_scans,
                **NAMED_SURFACES,
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/aggregate_elastic_limit.py"


rule compute_scaled_pull_off:
    """Pull-off of a filtered master over radii, ranges of adhesion and contact areas."""
    input:
        scan=PATTERNS.stitched_substrate,
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("compute_scaled_pull_off.py"),
    output:
        PATTERNS.scaled,
    log:
        PATTERNS.log("compute_scaled_pull_off", PATTERNS.scaled),
    benchmark:
        PATTERNS.benchmark("compute_scaled_pull_off", PATTERNS.scaled)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "realization": int(w.scan),
                "side": w.side,
                "seed": STUDY["seed"],
                "transition": STUDY["scales"][w.side]["transition"],
                "window": STUDY["contact"]["window"],
                "hardness": STUDY["contact"]["hardness"],
                **{key: SCALING[key] for key in ("radii", "ranges", "preloads", "count")},
                **SCALING[w.side],
            }
        ),
    script:
        "../scripts/compute_scaled_pull_off.py"


rule scale_edges:
    """How the edges of the band scale with R, rho and the contact area: scaling.nc."""
    input:
        masters=list(INSIGHT_FILES.scaled),
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
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
                "masters": list(INSIGHT_FILES.scaled.values()),
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


rule filter_windows:
    """Pull-off on windows and whole surfaces of one spectrum, with and without long waves."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("filter_windows.py"),
    output:
        PATTERNS.filtered_windows,
    log:
        PATTERNS.log("filter_windows", PATTERNS.filtered_windows),
    benchmark:
        PATTERNS.benchmark("filter_windows", PATTERNS.filtered_windows)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "filters": {
                    "sizes": [SCAN_SIZES["size"], SCAN_SIZES["edges"]["size"]],
                    "pixel_size": SCAN_SIZES["size"] / SCAN_SIZES["pixels"],
                    **{key: SCAN_SIZES["edges"][key] for key in ("realizations", "cutoffs")},
                    "seed": STUDY["seed"],
                    "contacts": WINDOW_CONTACTS
                    | {
                        "each": SCAN_SIZES["edges"]["windows"],
                        "ranges": [STUDY["scales"]["range"]],
                    },
                },
            }
        ),
    script:
        "../scripts/filter_windows.py"


rule try_scan_sizes:
    """How large a scan must be, from random surfaces, tested on the study's: scan_size.nc."""
    input:
        windows=list(INSIGHT_FILES.filtered_windows),
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        code=code_inputs("try_scan_sizes.py"),
    output:
        PATTERNS.dataset("scan_size"),
    log:
        PATTERNS.log("try_scan_sizes"),
    benchmark:
        PATTERNS.benchmark("try_scan_sizes")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "rho": STUDY["scales"]["range"],
                "scan_size": STUDY["scan"]["size"],
                "tolerance": STUDY["scales"]["tolerance"],
                "trials": {
                    **{
                        key: SCAN_SIZES[key]
                        for key in ("size", "pixels", "realizations", "radii", "excess")
                    },
                    "count": SCAN_SIZES["spectra"],
                    "seed": STUDY["seed"],
                    "confidence": STUDY["inference"]["confidence"],
                    "contacts": WINDOW_CONTACTS
                    | {"each": SCAN_SIZES["windows"], "ranges": SCAN_SIZES["ranges"]},
                },
            }
        ),
    script:
        "../scripts/try_scan_sizes.py"
