# Classical models: effective work of adhesion, models of rough adhesion.


rule apply_classical_models:
    """Apply classical models of smooth and rough adhesion to the published forces: classical.nc."""
    input:
        fit=rules.fit_published.output[0],
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("apply_classical_models.py"),
    output:
        PATTERNS.dataset("classical"),
    params:
        canonical=canonical(SAMPLING),
    script:
        "../scripts/apply_classical_models.py"
