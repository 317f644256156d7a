# Whether contacts yield, by the slopes of a surface.


rule find_elastic_limit:
    """Compare elastic pressures with the hardness by shortest wavelength: elastic_limit.nc."""
    input:
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        code=code_inputs("find_elastic_limit.py"),
    output:
        PATTERNS.dataset("elastic_limit"),
    log:
        PATTERNS.log("find_elastic_limit"),
    benchmark:
        PATTERNS.benchmark("find_elastic_limit")
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "hardness": STUDY["contact"]["hardness"],
            }
        ),
    script:
        "../scripts/find_elastic_limit.py"
