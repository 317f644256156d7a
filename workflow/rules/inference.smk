# Inference: edges of the band and exponents, range and work of adhesion from published forces.


rule find_edges:
    """Find the wavelengths whose removal changes the force: edges.nc."""
    input:
        scales=PATTERNS.dataset("scales"),
        code=code_inputs("find_edges.py"),
    output:
        PATTERNS.dataset("edges"),
    params:
        parameters=parameters(tolerance=STUDY["scales"]["tolerance"], sampling=SAMPLING),
    script:
        "../scripts/find_edges.py"


rule compare_short_edges:
    """Compare short edges and forces by radius and load (exponents.nc), by range and plasticity (enhancement.nc)."""
    input:
        exponents=FILES.paths(PATTERNS.filtered, CHUNKS.filtered_masters("exponents")),
        enhancement=FILES.paths(PATTERNS.filtered, CHUNKS.filtered_masters("enhancement")),
        code=code_inputs("compare_short_edges.py"),
    output:
        exponents=PATTERNS.dataset("exponents"),
        enhancement=PATTERNS.dataset("enhancement"),
    params:
        parameters=parameters(
            surfaces={
                purpose: [row.surface for row in CHUNKS.filtered_masters(purpose)]
                for purpose in ("exponents", "enhancement")
            },
            realizations=STUDY["exponents"]["realizations"],
            tolerance=STUDY["scales"]["tolerance"],
            area=FILES.contact.area,
            sampling=SAMPLING,
            **NAMED_SURFACES,
        ),
    script:
        "../scripts/compare_short_edges.py"


rule fit_published:
    """Fit range and work of adhesion to the published forces: fit.nc."""
    input:
        adhesion=PATTERNS.dataset("adhesion"),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("fit_published.py"),
    output:
        PATTERNS.dataset("fit"),
    params:
        parameters=parameters(reference_surface=STUDY["reference_surface"], sampling=SAMPLING),
    script:
        "../scripts/fit_published.py"
