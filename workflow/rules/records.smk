# Records of a study: its configuration, the list of its variables, and the check of its files.

from pathlib import Path

from hardcontact.config.configuration import omitted_targets

#: The datasets that the rules above make in the results; a study without forces has no fit.
DATASETS = [
    path
    for stage in workflow.rules
    for path in stage.output
    if path.startswith(f"{PATTERNS.results}/")
    and path.endswith(".nc")
    and Path(path).stem not in omitted_targets(STUDY)
]


rule keep_configuration:
    """Keep the configuration and the table of surfaces with the results."""
    input:
        surfaces=STUDY["surfaces"],
        code=code_inputs("keep_configuration.py"),
    output:
        configuration=PATTERNS.result("configuration.yaml"),
        surfaces=PATTERNS.result("surfaces.tsv"),
    log:
        PATTERNS.log("keep_configuration"),
    benchmark:
        PATTERNS.benchmark("keep_configuration")
    params:
        canonical=canonical(config),
    script:
        "../scripts/keep_configuration.py"


rule list_variables:
    """List every variable of the study's datasets, with dimensions, unit and meaning."""
    input:
        datasets=sorted(DATASETS),
        code=code_inputs("list_variables.py"),
    output:
        PATTERNS.result("datasets.md"),
    log:
        PATTERNS.log("list_variables"),
    benchmark:
        PATTERNS.benchmark("list_variables")
    params:
        canonical=canonical({}),
    script:
        "../scripts/list_variables.py"


rule verify:
    """Check whether the files of the study match what they were made from; write nothing."""
    log:
        PATTERNS.log("verify"),
    retries: 0
    params:
        canonical=canonical({"results": PATTERNS.results}),
    script:
        "../scripts/verify.py"
