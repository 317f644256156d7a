# How the edges of the band scale with the sphere, the range of adhesion and the contact area.


rule scale_edges:
    """How the edges of the band scale with R, rho and the contact area: scaling.nc."""
    input:
        masters=FILES.paths(PATTERNS.filtered, FILES.masters("scaling")),
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        computed="workflow/hardcontact/theory/prediction.csv",
        formulas="resources/validation/edges.csv",
        code=code_inputs("scale_edges.py"),
    output:
        PATTERNS.dataset("scaling"),
    log:
        PATTERNS.log("scale_edges"),
    benchmark:
        PATTERNS.benchmark("scale_edges")
    params:
        canonical=canonical(
            {
                "masters": [row.surface for row in FILES.masters("scaling")],
                "realizations": INSIGHT["realizations"],
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "tolerance": STUDY["scales"]["tolerance"],
                **SAMPLING,
                "sphere_radius": STUDY["sphere"]["radius"],
                "rho": STUDY["scales"]["range"],
                "area": STUDY["contact"]["preload"] / STUDY["contact"]["hardness"] * 1e18,
            }
        ),
    script:
        "../scripts/scale_edges.py"
