# Adhesion: rigid and plastic pull-off forces of the sphere on every substrate scan.
# Names in capitals that are not defined here: common.smk and surfaces.smk.


rule compute_pull_off:
    """Compute the pull-off forces on a substrate scan, at each position on the sphere."""
    input:
        substrate=lambda w: FILES.mirrored_scan_path(w.surface, int(w.scan)),
        spheres=FILES.mirrored_scan_paths(SELECTION.sphere_surface),
    output:
        STORE.pull_off,
    params:
        parameters=SETTINGS["pull_off"],  # sphere_positions, positions_per_row, contact, ranges
    script:
        "../scripts/compute_pull_off.py"


rule aggregate_adhesion:
    """Gather the pull-off forces on all substrate scans: adhesion.nc."""
    input:
        scans=FILES.paths(STORE.pull_off, PLAN.substrate_scan_ids),
    output:
        RESULTS.dataset("adhesion"),
    params:
        parameters=dict(
            scan_ids=PLAN.substrate_scan_ids,
            **LABELS_AND_SOURCES,
            sphere_radius=STUDY["sphere"]["radius"],
            rho=STUDY["adhesion"]["range"],
        ),
    script:
        "../scripts/aggregate_adhesion.py"
