# Octaves: forces on whole surfaces and on scans, with each octave of waves changed.
# Names in capitals that are not defined here: common.smk and surfaces.smk.


rule compute_whole_surface_forces:
    """Compute the forces on whole substitute surfaces, also with each octave changed."""
    input:
        **DESCRIPTION_INPUTS,
        **SUBSTITUTE_INPUTS,
    output:
        STORE.whole_surfaces,
    params:
        parameters=lambda w: dict(
            # seed, scan_grid, featured_surface, contact, grid, ranges
            **SETTINGS["whole_surfaces"],
            surface=w.surface,
            surface_numbers=list(range(int(w.first), int(w.last) + 1)),
            has_features=w.surface == PLAN.featured_surface,
        ),
    script:
        "../scripts/compute_whole_surface_forces.py"


rule compute_octave_forces:
    """Compute the forces on a scan with each octave changed."""
    input:
        mirrored=lambda w: FILES.contact_map_path(w.surface, int(w.scan)),
        sphere=SPHERE_SCAN,
    output:
        STORE.octave_forces,
    params:
        parameters=lambda w: dict(scan=int(w.scan), **SETTINGS["octave_forces"]),  # contact
    script:
        "../scripts/compute_octave_forces.py"


rule aggregate_sensitivity:
    """Gather how the force follows each octave: sensitivity.nc."""
    input:
        forces=[
            *FILES.paths(STORE.whole_surfaces, CHUNKS.whole_surfaces),
            *FILES.paths(STORE.octave_forces, PLAN.measured_scan_ids),
        ],
        adhesion=RESULTS.dataset("adhesion") if PLAN.measured_scan_ids else [],
    output:
        RESULTS.dataset("sensitivity"),
    params:
        parameters=dict(
            maps=[*CHUNKS.whole_surfaces, *PLAN.measured_scan_ids],
            **LABELS_AND_SOURCES,
            radius=STUDY["sphere"]["radius"],
            rho=STUDY["adhesion"]["range"],
            confidence=STUDY["intervals"]["confidence"],
        ),
    script:
        "../scripts/aggregate_sensitivity.py"
