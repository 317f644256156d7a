# Provenance: the configuration kept with the results, the RO-Crate, and the check of both.

from hardcontact.config.configuration import available_targets


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


rule describe_crate:
    """Describe inputs, outputs, software, authors, licence and paper for an archive."""
    input:
        [getattr(rules, target).input for target in available_targets(STUDY)],
        rules.keep_configuration.output,
        citation="CITATION.cff",
        environment=PINS[0],
        code=code_inputs("describe_crate.py"),
    output:
        PATTERNS.result("ro-crate-metadata.json"),
    log:
        PATTERNS.log("describe_crate"),
    benchmark:
        PATTERNS.benchmark("describe_crate")
    params:
        canonical=canonical({"study": STUDY["study"]}),
    script:
        "../scripts/describe_crate.py"


rule crate:
    """Make the study and its description for an archive."""
    input:
        rules.describe_crate.output,


rule verify:
    """Check whether the files of the study match what they were made from; write nothing."""
    log:
        PATTERNS.log("verify"),
    retries: 0
    params:
        canonical=canonical({"results": PATTERNS.results}),
    script:
        "../scripts/verify.py"
