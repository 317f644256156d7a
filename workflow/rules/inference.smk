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


rule fit_exponents:
    """Fit exponents of forces and edges to radius and load: exponents.nc."""
    input:
        masters=FILES.paths(PATTERNS.master_forces, CHUNKS.filtered_masters("exponents")),
        code=code_inputs("fit_exponents.py"),
    output:
        PATTERNS.dataset("exponents"),
    params:
        parameters=parameters(
            surfaces=[row.surface for row in CHUNKS.filtered_masters("exponents")],
            realizations=STUDY["exponents"]["realizations"],
            tolerance=STUDY["scales"]["tolerance"],
            area=FILES.contact.area,
            confidence=STUDY["inference"]["confidence"],
            **NAMED_SURFACES,
        ),
    script:
        "../scripts/fit_exponents.py"


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
