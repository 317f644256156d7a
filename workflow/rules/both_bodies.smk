# The roughness of both bodies in one: that of the scanned sphere, added to that of each substrate.
# Names in capitals that are not defined here: common.smk and surfaces.smk.

from hardcontact.files.paths import any_name_pattern

#: The substrates to which the roughness of a scanned sphere is added; the others stay as they are.
COMBINED_SURFACES = any_name_pattern(PLAN.combined_surfaces)


rule combine_scans:
    """Add the roughness of a scan of the sphere, at a random position, to that of a substrate."""
    input:
        substrate=lambda w: FILES.mirrored_scan_path(w.surface, int(w.scan)),
        sphere=lambda w: FILES.mirrored_scan_path(
            SELECTION.sphere_surface, PLAN.sphere_scan_number(w.surface, int(w.scan))
        ),
    output:
        STORE.combined_scans,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            scan=int(w.scan),
            sphere_scan=PLAN.sphere_scan_number(w.surface, int(w.scan)),
            **SETTINGS["both_bodies"],  # seed, sphere
        ),
    script:
        "../scripts/combine_scans.py"


rule combine_spectra:
    """Add the spectrum of the sphere to that of a substrate."""
    input:
        substrate=lambda w: FILES.spectrum_path(w.surface),
        sphere=lambda w: FILES.spectrum_path(SELECTION.sphere_surface),
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
        substrate=lambda w: FILES.path(STORE.sampled_spectra, w.surface, realization=w.realization),
        sphere=lambda w: FILES.path(
            STORE.sampled_spectra, SELECTION.sphere_surface, realization=w.realization
        ),
    output:
        STORE.combined_sampled_spectra,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/combine_sampled_spectra.py"
