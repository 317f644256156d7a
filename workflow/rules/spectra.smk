# Spectra: sampled for your measured surfaces, gathered for all surfaces.
# Names in capitals that are not defined here: common.smk and surfaces.smk.


rule sample_spectra:
    """Sample spectra of a surface, one per realization, within the uncertainty of its scans."""
    input:
        measurements=lambda w: FILES.measurement_paths(w.surface),
    output:
        expand(
            STORE.sampled_spectra,
            realization=range(1, STUDY["band"]["masters"] + 1),
            allow_missing=True,
        ),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            contact_scan_indices=SELECTION.contact_scan_indices(w.surface),
            tip_radii=SELECTION.tip_radii(w.surface),
            sphere_radius=PLAN.sphere_radius(w.surface),
            **SETTINGS["sampled_spectra"],  # seed, levelling
        ),
    script:
        "../scripts/sample_spectra.py"


rule aggregate_spectra:
    """Gather the spectra of all surfaces, measured or described: spectra.nc."""
    input:
        spectra=[FILES.contact_spectrum_path(surface) for surface in SELECTION.surfaces],
    output:
        RESULTS.dataset("spectra"),
    params:
        parameters=dict(
            surfaces=SELECTION.surfaces,  # the order of the inputs
            labels=SELECTION.labels,
            descriptions={
                surface: SELECTION.description_path(surface) for surface in SELECTION.substitutes
            },
        ),
    script:
        "../scripts/aggregate_spectra.py"
