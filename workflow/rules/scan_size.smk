# How large a scan must be for its force and its long edge.


rule judge_scan_size:
    """Join the validation table with the creases of the study's scans: scan_size.nc."""
    input:
        validation="resources/validation/scan_size.nc",
        asperities=PATTERNS.dataset("asperities"),
        code=code_inputs("judge_scan_size.py"),
    output:
        PATTERNS.dataset("scan_size"),
    log:
        PATTERNS.log("judge_scan_size"),
    benchmark:
        PATTERNS.benchmark("judge_scan_size")
    params:
        canonical=canonical(
            {
                "rho": STUDY["scales"]["range"],
                "scan_size": STUDY["scan"]["size"],
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/judge_scan_size.py"
