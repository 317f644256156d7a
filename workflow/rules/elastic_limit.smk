# Contacts that do not yield, and the force that they would have.


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
        scans=FILES.paths(PATTERNS.elastic_limit, FILES.pairs_in_turn),
        elastic=PATTERNS.dataset("elastic"),
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
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
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/aggregate_elastic_limit.py"
