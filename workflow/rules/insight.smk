# Insight: what decides the critical band, and how far the method can be trusted.

INSIGHT = STUDY["insight"]
INSIGHT_RANGES = sorted({*INSIGHT["ranges"], STUDY["scales"]["range"]})


rule compare_closed_form:
    """Compare the closed form of the pull-off force with random surfaces: closed_form.nc."""
    input:
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("compare_closed_form.py"),
    output:
        PATTERNS.dataset("closed_form"),
    log:
        PATTERNS.log("compare_closed_form"),
    benchmark:
        PATTERNS.benchmark("compare_closed_form")
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "contact": {
                    **STUDY["contact"],
                    "count": INSIGHT["count"],
                    "radius": STUDY["sphere"]["radius"],
                },
                "trial": {
                    **{key: INSIGHT[key] for key in ("pixels", "realizations", "sizes")},
                    "ranges": INSIGHT_RANGES,
                    "rho": STUDY["scales"]["range"],
                    "tolerance": STUDY["scales"]["tolerance"],
                    "confidence": STUDY["inference"]["confidence"],
                    "seed": STUDY["seed"],
                },
            }
        ),
    script:
        "../scripts/compare_closed_form.py"


rule compare_statistics:
    """Compare the law of the scatter of forces with computed and published scatter: statistics.nc."""
    input:
        **PUBLISHED_TABLES,
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        fit=PATTERNS.dataset("fit"),
        validation="resources/validation/statistics.csv",
        code=code_inputs("compare_statistics.py"),
    output:
        PATTERNS.dataset("statistics"),
    log:
        PATTERNS.log("compare_statistics"),
    benchmark:
        PATTERNS.benchmark("compare_statistics")
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "load": {key: STUDY["contact"][key] for key in ("preload", "hardness")},
                "radius": STUDY["sphere"]["radius"],
                "ranges": INSIGHT_RANGES,
                "rho": STUDY["scales"]["range"],
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/compare_statistics.py"
