# Provenance: the configuration kept with the results, the RO-Crate, and the check of both.


rule keep_configuration:
    input:
        surfaces=STUDY["surfaces"],
        code=code("keep_configuration.py"),
    output:
        configuration=f"{RESULTS}/configuration.yaml",
        surfaces=f"{RESULTS}/surfaces.tsv",
        record=f"{RESULTS}/provenance/configuration.json",
    params:
        canonical=canonical(config),
    log:
        f"{RESULTS}/logs/keep_configuration.log",
    benchmark:
        f"{RESULTS}/benchmarks/keep_configuration.tsv"
    script:
        "../scripts/keep_configuration.py"


rule describe_crate:
    # inputs, outputs, software, authors, licence and paper, for an archive
    input:
        rules.topography.input,
        rules.adhesion.input,
        rules.elastic.input,
        rules.plasticity.input,
        rules.asperities.input,
        rules.scales.input,
        rules.classical.input,
        rules.robustness.input,
        rules.claims.input,
        rules.figures.input,
        rules.pages.input,
        rules.keep_configuration.output,
        citation="CITATION.cff",
        environment="environment.txt",
        code=code("describe_crate.py"),
    output:
        f"{RESULTS}/ro-crate-metadata.json",
    params:
        canonical=canonical({"study": STUDY["study"]}),
    log:
        f"{RESULTS}/logs/describe_crate.log",
    benchmark:
        f"{RESULTS}/benchmarks/describe_crate.tsv"
    script:
        "../scripts/describe_crate.py"


rule crate:
    input:
        rules.describe_crate.output,


rule verify:
    # writes nothing: whether the files of the study match what they were made from
    params:
        canonical=canonical({"results": RESULTS}),
    log:
        f"{RESULTS}/logs/verify.log",
    retries: 0
    script:
        "../scripts/verify.py"
