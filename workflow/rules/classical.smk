# Classical models: effective work of adhesion, models of rough adhesion.


rule apply_classical_models:
    """Apply classical models of smooth and rough adhesion to the published forces: classical.nc."""
    input:
        **PUBLISHED_TABLES,
        fit=PATTERNS.dataset("fit"),
        code=code_inputs("apply_classical_models.py"),
    output:
        PATTERNS.dataset("classical"),
    params:
        parameters=parameters(**SAMPLING),
    script:
        "../scripts/apply_classical_models.py"
