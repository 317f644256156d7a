# Fits to the published forces: range and work of adhesion, and classical models of adhesion.


# The user's forces are often too few for one pair: `fit_measured` finds all that they permit.
rule fit_published:
    """Fit one pair of range and work of adhesion to the published forces: fit.nc."""
    input:
        adhesion=RESULTS.dataset("adhesion"),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        RESULTS.dataset("fit"),
    params:
        parameters=dict(reference_surface=STUDY["reference_surface"], sampling=SAMPLING),
    script:
        "../scripts/fit_published.py"


rule apply_classical_models:
    """Apply classical models of smooth and rough adhesion to the published forces: classical.nc."""
    input:
        **PUBLISHED_TABLES,
        fit=RESULTS.dataset("fit"),
    output:
        RESULTS.dataset("classical"),
    params:
        parameters=SAMPLING,
    script:
        "../scripts/apply_classical_models.py"
