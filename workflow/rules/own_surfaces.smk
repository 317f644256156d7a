# Own surfaces: edges of the band, predicted force, fit to own forces.


rule aggregate_spectra:
    """Gather the spectra of all surfaces, measured or described: spectra.nc."""
    input:
        spectra=[FILES.roughness_spectrum_path(surface) for surface in SELECTION.surfaces],
        code=code_inputs("aggregate_spectra.py"),
    output:
        PATTERNS.dataset("spectra"),
    params:
        parameters=parameters(
            surfaces=SELECTION.surfaces,  # the order of the inputs
            labels=SELECTION.labels,
            descriptions={
                surface: SELECTION.description(surface) for surface in FILES.conditioning_paths
            },
        ),
    script:
        "../scripts/aggregate_spectra.py"


rule sample_spectra:
    """Sample a spectrum for each realization, within what the measurements of a surface leave open."""
    input:
        measurements=lambda w: FILES.measurement_paths(w.surface),
        code=code_inputs("sample_spectra.py"),
    output:
        expand(
            PATTERNS.sampled_spectrum,
            realization=range(1, STUDY["scales"]["realizations"] + 1),
            allow_missing=True,
        ),
    params:
        parameters=lambda w: parameters(
            surface=w.surface,
            seed=STUDY["seed"],
            contact_scan_indices=SELECTION.contact_scan_indices(w.surface),
            **FILES.measurement_settings(w.surface),
        ),
    script:
        "../scripts/sample_spectra.py"


#: The scans of masters, and how forces on them are compared.
MASTER_PARAMETERS = {
    "scan_counts": {name: len(SELECTION.scans(name)) for name in SELECTION.substrates},
    "tiles": STUDY["scales"]["long"]["tiles"],
    "tolerance": STUDY["scales"]["tolerance"],
    "confidence": STUDY["inference"]["confidence"],
}


rule find_edges_of_scans:
    """Find the wavelengths whose removal changes the force: edges.nc."""
    input:
        adhesion=PATTERNS.dataset("adhesion"),
        scales=PATTERNS.dataset("scales"),
        sensitivity=PATTERNS.dataset("sensitivity"),
        code=code_inputs("find_edges_of_scans.py"),
    output:
        PATTERNS.dataset("edges"),
    params:
        parameters=parameters(**MASTER_PARAMETERS),
    script:
        "../scripts/find_edges_of_scans.py"


rule predict_force:
    """Predict the pull-off force, also with extrapolated roughness: force.nc."""
    input:
        adhesion=PATTERNS.dataset("adhesion"),
        scales=PATTERNS.dataset("scales"),
        topography=PATTERNS.dataset("topography"),
        spectra=PATTERNS.dataset("spectra"),
        sensitivity=PATTERNS.dataset("sensitivity"),
        code=code_inputs("predict_force.py"),
    output:
        PATTERNS.dataset("force"),
    params:
        parameters=parameters(
            contact=CONTACT_AT_RANGE | {"work": STUDY["adhesion"]["work"]},
            **MASTER_PARAMETERS,
        ),
    script:
        "../scripts/predict_force.py"


if STUDY["forces"] != NONE:

    rule fit_measured:
        """Fit range and work of adhesion to own pull-off forces: fit.nc."""
        input:
            adhesion=PATTERNS.dataset("adhesion"),
            force=PATTERNS.dataset("force"),
            topography=PATTERNS.dataset("topography"),
            forces=STUDY["forces"],
            code=code_inputs("fit_measured.py"),
        output:
            PATTERNS.dataset("fit"),
        params:
            parameters=parameters(**SAMPLING),
        script:
            "../scripts/fit_measured.py"
