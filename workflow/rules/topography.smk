# Topography: rms metrics and PSDs by scan; Table 1.


rule aggregate_topography:
    """Measure rms metrics and power spectra of all scans, with averages: topography.nc."""
    input:
        scans=FILES.paths(PATTERNS.levelled, FILES.scans),
        spectra=[FILES.spectrum_path(surface) for surface in SELECTION.surfaces],
        conditionings=FILES.conditioning_paths.values(),
        code=code_inputs("aggregate_topography.py"),
    output:
        PATTERNS.dataset("topography"),
    params:
        parameters=parameters(
            scan_keys=FILES.scans,
            conditioned=list(FILES.conditioning_paths),
            **NAMED_SURFACES,
            sphere_surface=SPHERE,
            reference_surface=STUDY["reference_surface"],
            confidence=STUDY["inference"]["confidence"],
        ),
    script:
        "../scripts/aggregate_topography.py"
