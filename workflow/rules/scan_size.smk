# How large a scan must be for its force and its long edge.

SCAN_SIZES = INSIGHT["scan_sizes"]
WINDOW_CONTACTS = {
    **{key: SCAN_SIZES[key] for key in ("sizes", "count")},
    "radius": STUDY["sphere"]["radius"],
    "window": STUDY["contact"]["window"],
    **{key: STUDY["contact"][key] for key in ("preload", "hardness")},
}


rule filter_windows:
    """Pull-off on windows and whole surfaces of one spectrum, with and without long waves."""
    input:
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("filter_windows.py"),
    output:
        PATTERNS.filtered_windows,
    log:
        PATTERNS.log("filter_windows", PATTERNS.filtered_windows),
    benchmark:
        PATTERNS.benchmark("filter_windows", PATTERNS.filtered_windows)
    resources:
        mem_mb=1000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "filters": {
                    "sizes": [SCAN_SIZES["size"], SCAN_SIZES["edges"]["size"]],
                    "pixel_size": SCAN_SIZES["size"] / SCAN_SIZES["pixels"],
                    **{key: SCAN_SIZES["edges"][key] for key in ("realizations", "cutoffs")},
                    "seed": STUDY["seed"],
                    "contacts": WINDOW_CONTACTS
                    | {
                        "each": SCAN_SIZES["edges"]["windows"],
                        "ranges": [STUDY["scales"]["range"]],
                    },
                },
            }
        ),
    script:
        "../scripts/filter_windows.py"


rule try_scan_sizes:
    """How large a scan must be, from random surfaces, tested on the study's: scan_size.nc."""
    input:
        windows=[FILES.path(PATTERNS.filtered_windows, name) for name in SELECTION.substrates],
        spectra=[FILES.spectrum(surface) for surface in SELECTION.substrates],
        asperities=PATTERNS.dataset("asperities"),
        code=code_inputs("try_scan_sizes.py"),
    output:
        PATTERNS.dataset("scan_size"),
    log:
        PATTERNS.log("try_scan_sizes"),
    benchmark:
        PATTERNS.benchmark("try_scan_sizes")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "surfaces": SELECTION.substrates,
                **NAMED_SURFACES,
                "rho": STUDY["scales"]["range"],
                "scan_size": STUDY["scan"]["size"],
                "tolerance": STUDY["scales"]["tolerance"],
                "trials": {
                    **{
                        key: SCAN_SIZES[key]
                        for key in ("size", "pixels", "realizations", "radii", "excess")
                    },
                    "count": SCAN_SIZES["spectra"],
                    "seed": STUDY["seed"],
                    "confidence": STUDY["inference"]["confidence"],
                    "contacts": WINDOW_CONTACTS
                    | {"each": SCAN_SIZES["windows"], "ranges": SCAN_SIZES["ranges"]},
                },
            }
        ),
    script:
        "../scripts/try_scan_sizes.py"
