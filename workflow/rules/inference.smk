# Inference: edges of the band, range and work of adhesion from published forces.


rule find_edges:
    """Find the wavelengths whose removal changes the force: edges.nc."""
    input:
        scales=rules.aggregate_scales.output[0],
        code=code_inputs("find_edges.py"),
    output:
        PATTERNS.dataset("edges"),
    log:
        PATTERNS.log("find_edges"),
    benchmark:
        PATTERNS.benchmark("find_edges")
    params:
        canonical=canonical(
            {
                "tolerance": STUDY["scales"]["tolerance"],
                **SAMPLING,
            }
        ),
    script:
        "../scripts/find_edges.py"


rule fit_published:
    """Fit range and work of adhesion to the published forces: fit.nc."""
    input:
        adhesion=rules.aggregate_adhesion.output[0],
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("fit_published.py"),
    output:
        PATTERNS.dataset("fit"),
    log:
        PATTERNS.log("fit_published"),
    benchmark:
        PATTERNS.benchmark("fit_published")
    params:
        canonical=canonical(
            {
                **STUDY["inference"],
                "reference_surface": STUDY["reference_surface"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/fit_published.py"
