# Scans: substitutes where none was measured; all scans are then prepared in the same way.


rule calibrate_spectrum:
    """Make the spectrum of a substitute from its description and Table 1."""
    input:
        description=lambda w: SELECTION.description(w.surface),
        tables=lambda w: SELECTION.tables(w.surface),  # named by the description
        published_table1=PUBLISHED["published_table1"],
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("calibrate_spectrum.py"),
    output:
        PATTERNS.calibrated_spectrum,
    log:
        PATTERNS.log("calibrate_spectrum", PATTERNS.calibrated_spectrum),
    benchmark:
        PATTERNS.benchmark("calibrate_spectrum", PATTERNS.calibrated_spectrum)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "seed": STUDY["seed"],
                **FILES.surface_variants[w.variant].parameters(
                    STUDY["topography"], SELECTION.skewness(w.surface)
                ),
            }
        ),
    script:
        "../scripts/calibrate_spectrum.py"


rule extrapolate_spectrum:
    """Make the spectrum of a measured surface from its own scans."""
    input:
        scans=lambda w: FILES.topographies_of(w.surface),
        code=code_inputs("extrapolate_spectrum.py"),
    output:
        PATTERNS.extrapolated_spectrum,
    log:
        PATTERNS.log("extrapolate_spectrum", PATTERNS.extrapolated_spectrum),
    benchmark:
        PATTERNS.benchmark("extrapolate_spectrum", PATTERNS.extrapolated_spectrum)
    params:
        canonical=canonical({}),
    script:
        "../scripts/extrapolate_spectrum.py"


rule synthesize_scan:
    """Make a substitute scan, as a file that the scan reader knows."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("synthesize_scan.py"),
    output:
        PATTERNS.substitute,
    log:
        PATTERNS.log("synthesize_scan", PATTERNS.substitute),
    benchmark:
        PATTERNS.benchmark("synthesize_scan", PATTERNS.substitute)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "number": int(w.scan),
                "scan": {
                    key: STUDY["scan"][key] for key in ("pixels", "size", "realization_pixels")
                },
                "seed": STUDY["seed"],
                "sphere_radius": STUDY["sphere"]["radius"] if w.surface == SPHERE else None,
            }
        ),
    script:
        "../scripts/synthesize_scan.py"


rule prepare_scan:
    """Level a scan, subtract the sphere if it shows one, and stitch it to its mirror images."""
    input:
        scan=lambda w: FILES.scan(w.surface, int(w.scan), w.variant),
        code=code_inputs("prepare_scan.py"),
    output:
        scan=PATTERNS.levelled,
        stitched=PATTERNS.stitched,
    log:
        PATTERNS.log("prepare_scan", PATTERNS.levelled),
    benchmark:
        PATTERNS.benchmark("prepare_scan", PATTERNS.levelled)
    params:
        canonical=lambda w: canonical(
            {
                "source": SELECTION.basis[w.surface],
                "dataset": SELECTION.dataset(w.surface, int(w.scan)),
                "undefined_pixels": SELECTION.undefined_pixels(
                    w.surface, STUDY["scan"]["undefined_pixels"]
                ),
                "sphere_radius": STUDY["sphere"]["radius"] if w.surface == SPHERE else None,
            }
        ),
    script:
        "../scripts/prepare_scan.py"
