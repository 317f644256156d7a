# Sets: many equally good sets of substitute scans, drawn from pools, and the numbers of each.

from hardcontact.paper.evaluation import replicated_statements
from hardcontact.config.patterns import STUDY_VARIANT


rule compute_pool:
    """Compute the forces of some scans of a pool at several heights of each."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        published_table1=PUBLISHED["published_table1"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("compute_pool.py"),
    output:
        PATTERNS.pool,
    log:
        PATTERNS.log("compute_pool", PATTERNS.pool),
    benchmark:
        PATTERNS.benchmark("compute_pool", PATTERNS.pool)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(pool_parameters(w.surface, w.variant, w.first, w.last)),
    script:
        "../scripts/compute_pool.py"


rule judge_sets:
    """Draw all sets, and compute of each what the statements of the paper are about: sets.nc."""
    input:
        topography=rules.aggregate_topography.output[0],
        adhesion=rules.aggregate_adhesion.output[0],
        pools=FILES.paths(PATTERNS.pool, FILES.chunks),
        smooth_spheres=FILES.paths(PATTERNS.mean_forces, FILES.smooth_forces),
        masters=FILES.paths(PATTERNS.filtered, FILES.varied_masters("sets")),
        published_pull_off=PUBLISHED["published_pull_off"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("judge_sets.py"),
    output:
        PATTERNS.dataset("sets"),
    log:
        PATTERNS.log("judge_sets"),
    benchmark:
        PATTERNS.benchmark("judge_sets")
    resources:
        mem_mb=2000,
    params:
        canonical=canonical(
            {
                "chunks": FILES.chunks,
                "pooled": SELECTION.pooled,
                "masters": [row.surface for row in FILES.varied_masters("sets")],
                "realizations": STUDY["sets"]["realizations"],
                "load": FILES.contact.load,
                "statements": replicated_statements("resources/paper/claims.csv"),
                "settings": {
                    "seed": STUDY["seed"],
                    "replicates": STUDY["sets"]["replicates"],
                    "realizations": STUDY["scales"]["realizations"],
                    "reference_surface": STUDY["reference_surface"],
                    "tolerance": STUDY["scales"]["tolerance"],
                    "confidence": STUDY["inference"]["confidence"],
                },
            }
        ),
    script:
        "../scripts/judge_sets.py"


rule compute_protruded:
    """Compute the forces on some surfaces with rare protrusions."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface),
        published_table1=PUBLISHED["published_table1"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("compute_protruded.py"),
    output:
        PATTERNS.protruded,
    log:
        PATTERNS.log("compute_protruded", PATTERNS.protruded),
    benchmark:
        PATTERNS.benchmark("compute_protruded", PATTERNS.protruded)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(pool_parameters(w.surface, STUDY_VARIANT, w.first, w.last)),
    script:
        "../scripts/compute_protruded.py"


rule judge_protruded:
    """Fit range and work of adhesion if one surface had rare protrusions: protruded.nc."""
    input:
        protruded=FILES.paths(PATTERNS.protruded, FILES.protruded_chunks),
        sets=rules.judge_sets.output[0],
        published_pull_off=PUBLISHED["published_pull_off"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("judge_protruded.py"),
    output:
        PATTERNS.dataset("protruded"),
    log:
        PATTERNS.log("judge_protruded"),
    benchmark:
        PATTERNS.benchmark("judge_protruded")
    params:
        canonical=canonical(
            {
                "surface": FILES.protruded_surface,
                "label": SELECTION.labels[FILES.protruded_surface],
                "basis": SELECTION.basis[FILES.protruded_surface],
            }
        ),
    script:
        "../scripts/judge_protruded.py"


rule fit_without_surfaces:
    """Fit range and work of adhesion to all surfaces but one: leave_one_out.nc."""
    input:
        inference=rules.infer.output[0],
        sets=rules.judge_sets.output[0],
        published_pull_off=PUBLISHED["published_pull_off"],
        code=code_inputs("fit_without_surfaces.py"),
    output:
        PATTERNS.dataset("leave_one_out"),
    log:
        PATTERNS.log("fit_without_surfaces"),
    benchmark:
        PATTERNS.benchmark("fit_without_surfaces")
    params:
        canonical=canonical({}),
    script:
        "../scripts/fit_without_surfaces.py"


rule measure_standoff:
    """Compute how high published and computed forces put the apex of the sphere: standoff.nc."""
    input:
        topography=rules.aggregate_topography.output[0],
        adhesion=rules.aggregate_adhesion.output[0],
        published_pull_off=PUBLISHED["published_pull_off"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("measure_standoff.py"),
    output:
        PATTERNS.dataset("standoff"),
    log:
        PATTERNS.log("measure_standoff"),
    benchmark:
        PATTERNS.benchmark("measure_standoff")
    params:
        canonical=canonical({}),
    script:
        "../scripts/measure_standoff.py"


rule sets:
    """Make the numbers of many sets of substitutes, and what decides range and work of adhesion."""
    input:
        rules.judge_sets.output,
        rules.fit_without_surfaces.output,
        rules.judge_protruded.output,
        rules.measure_standoff.output,
