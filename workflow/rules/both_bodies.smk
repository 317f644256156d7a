# The roughness of both bodies in one, for own surfaces under a scanned sphere.

COMBINED = any_name_pattern(FILES.combined_surfaces)


rule combine_scans:
    """Add the roughness of a scan of the sphere, at a random position, to that of a substrate."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=lambda w: FILES.stitched_path(SPHERE, FILES.sphere_scan(w.surface, int(w.scan))),
        code=code_inputs("combine_scans.py"),
    output:
        PATTERNS.combined_scan,
    wildcard_constraints:
        surface=COMBINED,
    params:
        parameters=lambda w: parameters(
            surface=w.surface,
            scan=int(w.scan),
            sphere_scan=FILES.sphere_scan(w.surface, int(w.scan)),
            seed=STUDY["seed"],
        ),
    script:
        "../scripts/combine_scans.py"


rule combine_spectra:
    """Add the spectrum of the sphere to that of a substrate."""
    input:
        substrate=lambda w: FILES.spectrum_path(w.surface),
        sphere=lambda w: FILES.spectrum_path(SPHERE),
        code=code_inputs("combine_spectra.py"),
    output:
        PATTERNS.combined_spectrum,
    wildcard_constraints:
        surface=COMBINED,
    params:
        parameters=lambda w: parameters(surface=w.surface),
    script:
        "../scripts/combine_spectra.py"


rule combine_sampled_spectra:
    """Add a sampled spectrum of the sphere to one of a substrate."""
    input:
        substrate=PATTERNS.sampled_spectrum,
        sphere=lambda w: FILES.path(PATTERNS.sampled_spectrum, SPHERE, realization=w.realization),
        code=code_inputs("combine_sampled_spectra.py"),
    output:
        PATTERNS.combined_sampled_spectrum,
    wildcard_constraints:
        surface=COMBINED,
    params:
        parameters=lambda w: parameters(surface=w.surface),
    script:
        "../scripts/combine_sampled_spectra.py"
