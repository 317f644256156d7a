# Fits to the published forces: range and work of adhesion, and classical models of adhesion.
# Names in capitals that are not defined here: common.smk.


# Your forces are often too few for one pair of range and work: `fit_measured` (own_surfaces.smk) finds
# all pairs that agree with the forces.
rule fit_published:
    """Fit range and work of adhesion of each contact model to the published forces: fit.nc."""
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
