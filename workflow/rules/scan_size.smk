# How large a scan must be for its force and its long edge.


rule judge_scan_size:
    """Take the surfaces of the study from the validation table: scan_size.nc."""
    input:
        validation="resources/validation/scan_size.nc",
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
                "surfaces": SELECTION.substrates,
                "scan_size": STUDY["scan"]["size"],
            }
        ),
    script:
        "../scripts/judge_scan_size.py"
