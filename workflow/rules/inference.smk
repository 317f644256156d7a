# Inference: edges of the band and exponents, range and work of adhesion from published forces.


rule find_edges:
    """Find the wavelengths whose removal changes the force: edges.nc."""
    input:
        scales=rules.aggregate_scales.output[0],
        code=code_inputs("find_edges.py"),
    output:
        PATTERNS.dataset("edges"),
    params:
        canonical=parameters(tolerance=STUDY["scales"]["tolerance"], sampling=SAMPLING),
    script:
        "../scripts/find_edges.py"


rule fit_exponents:
    """Fit how the force and the short edge scale with the radius and the load: scaling.nc."""
    input:
        masters=FILES.paths(PATTERNS.filtered, FILES.masters("scaling")),
        code=code_inputs("fit_exponents.py"),
    output:
        PATTERNS.dataset("scaling"),
    params:
        canonical=canonical(
            {
                "masters": [row.surface for row in FILES.masters("scaling")],
                "realizations": STUDY["scaling"]["realizations"],
                **NAMED_SURFACES,
                "tolerance": STUDY["scales"]["tolerance"],
                "confidence": STUDY["inference"]["confidence"],
                "area": FILES.contact.area,
            }
        ),
    script:
        "../scripts/fit_exponents.py"


rule fit_published:
    """Fit range and work of adhesion to the published forces: fit.nc."""
    input:
        adhesion=rules.aggregate_adhesion.output[0],
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("fit_published.py"),
    output:
        PATTERNS.dataset("fit"),
    params:
        canonical=parameters(reference_surface=STUDY["reference_surface"], sampling=SAMPLING),
    script:
        "../scripts/fit_published.py"
