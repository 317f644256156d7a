# What the scans of the user's surfaces show: spectra within the uncertainty of the measurements, and the
# roughness of the sphere added to that of each substrate.

from hardcontact.files.patterns import any_name_pattern

#: The substrates to which the roughness of a scanned sphere is added; the others stay as they are.
COMBINED_SURFACES = any_name_pattern(PLAN.combined_surfaces)


rule sample_spectra:
    """Sample a spectrum for each realization, within what the measurements of a surface leave open."""
    input:
        measurements=lambda w: FILES.measurement_paths(w.surface),
    output:
        expand(
            STORE.sampled_spectra,
            realization=range(1, STUDY["scales"]["realizations"] + 1),
            allow_missing=True,
        ),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            contact_scan_indices=SELECTION.contact_scan_indices(w.surface),
            tip_radii=SELECTION.tip_radii(w.surface),
            sphere_radius=PLAN.sphere_radius(w.surface),
            **SETTINGS["sampled_spectra"],
        ),
    script:
        "../scripts/sample_spectra.py"


rule combine_scans:
    """Add the roughness of a scan of the sphere, at a random position, to that of a substrate."""
    input:
        substrate=STORE.mirrored_substrates,
        sphere=lambda w: FILES.mirrored_scan_path(
            SELECTION.sphere, PLAN.sphere_scan(w.surface, int(w.scan))
        ),
    output:
        STORE.combined_scans,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            scan=int(w.scan),
            sphere_scan=PLAN.sphere_scan(w.surface, int(w.scan)),
            **SETTINGS["both_bodies"],
        ),
    script:
        "../scripts/combine_scans.py"


rule combine_spectra:
    """Add the spectrum of the sphere to that of a substrate."""
    input:
        substrate=lambda w: FILES.spectrum_path(w.surface),
        sphere=lambda w: FILES.spectrum_path(SELECTION.sphere),
    output:
        STORE.combined_spectra,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/combine_spectra.py"


rule combine_sampled_spectra:
    """Add a sampled spectrum of the sphere to one of a substrate."""
    input:
        substrate=STORE.sampled_spectra.replace("{shape}", "flat"),
        sphere=lambda w: FILES.path(
            STORE.sampled_spectra, SELECTION.sphere, realization=w.realization
        ),
    output:
        STORE.combined_sampled_spectra,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/combine_sampled_spectra.py"


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
                surface: SELECTION.description(surface) for surface in SELECTION.substitutes
            },
        ),
    script:
        "../scripts/aggregate_spectra.py"
