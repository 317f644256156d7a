# Sets: many equally good sets of substitute scans, sampled from pools, and the numbers of each.

from hardcontact.paper.evaluation import replicated_statements


rule compute_pool:
    """Compute the forces of some scans of a pool at several heights of each."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface),
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("compute_pool.py"),
    output:
        PATTERNS.pool,
    log:
        PATTERNS.log("compute_pool", PATTERNS.pool),
    benchmark:
        PATTERNS.benchmark("compute_pool", PATTERNS.pool)
    params:
        canonical=lambda w: canonical(pool_parameters(w)),
    script:
        "../scripts/compute_pool.py"


rule average_smooth_sphere:
    """Compute the mean forces of all scans of a surface on a smooth sphere."""
    input:
        scans=lambda w: [FILES.stitched(w.surface, scan) for scan in SELECTION.scans(w.surface)],
        code=code_inputs("average_smooth_sphere.py"),
    output:
        PATTERNS.smooth_sphere,
    log:
        PATTERNS.log("average_smooth_sphere", PATTERNS.smooth_sphere),
    benchmark:
        PATTERNS.benchmark("average_smooth_sphere", PATTERNS.smooth_sphere)
    params:
        canonical=lambda w: parameters(
            surface=w.surface,
            scans=SELECTION.scans(w.surface),
            contact=STUDY["contact"] | {"radius": STUDY["sphere"]["radius"]},
            ranges=RANGES,
        ),
    script:
        "../scripts/average_smooth_sphere.py"


rule compute_protruded:
    """Compute the forces on some surfaces with rare protrusions on them or on the sphere."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface),
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("compute_protruded.py"),
    output:
        PATTERNS.protruded,
    log:
        PATTERNS.log("compute_protruded", PATTERNS.protruded),
    benchmark:
        PATTERNS.benchmark("compute_protruded", PATTERNS.protruded)
    params:
        canonical=lambda w: parameters(
            **pool_parameters(w)
            # Of the other coatings the ratio of mean forces on the same scans is enough.
            | ({} if w.surface == FILES.protruded_coating else {"scans": 2}),
            protruded_body=w.protruded_body,
            coating=FILES.protruded_coating,
        ),
    script:
        "../scripts/compute_protruded.py"


rule judge_sets:
    """Sample all sets, and compute of each what the statements of the paper are about: sets.nc."""
    input:
        topography=rules.aggregate_topography.output[0],
        adhesion=rules.aggregate_adhesion.output[0],
        pools=FILES.paths(PATTERNS.pool, FILES.chunks),
        smooth_spheres=[FILES.path(PATTERNS.smooth_sphere, name) for name in SELECTION.pooled],
        masters=FILES.paths(PATTERNS.filtered, FILES.masters("sets")),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("judge_sets.py"),
    output:
        PATTERNS.dataset("sets"),
    log:
        PATTERNS.log("judge_sets"),
    benchmark:
        PATTERNS.benchmark("judge_sets")
    params:
        canonical=parameters(
            chunks=FILES.chunks,
            pooled=SELECTION.pooled,
            masters=[row.surface for row in FILES.masters("sets")],
            realizations=STUDY["sets"]["realizations"],
            load=FILES.contact.load,
            statements=replicated_statements("resources/paper/claims.csv"),
            settings={
                "seed": STUDY["seed"],
                "replicates": STUDY["sets"]["replicates"],
                "realizations": STUDY["scales"]["realizations"],
                "reference_surface": STUDY["reference_surface"],
                "tolerance": STUDY["scales"]["tolerance"],
                "confidence": STUDY["inference"]["confidence"],
            },
        ),
    script:
        "../scripts/judge_sets.py"


rule fit_protruded:
    """Find what decides the fit of range and work: protruded(_sphere).nc."""
    input:
        sets=rules.judge_sets.output[0],
        protruded=FILES.paths(PATTERNS.protruded, FILES.protruded_chunks(FILES.protruded_coating)),
        protruded_sphere=FILES.paths(PATTERNS.protruded, FILES.protruded_chunks(SPHERE)),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("fit_protruded.py"),
    output:
        protruded=PATTERNS.dataset("protruded"),
        protruded_sphere=PATTERNS.dataset("protruded_sphere"),
    log:
        PATTERNS.log("fit_protruded"),
    benchmark:
        PATTERNS.benchmark("fit_protruded")
    params:
        canonical=parameters(**named(FILES.protruded_coating)),
    script:
        "../scripts/fit_protruded.py"
