# Adhesion: rigid and plastic pull-off of every sphere scan on every substrate scan.


rule compute_pull_off:
    """Compute rigid and plastic pull-off of a substrate scan, under each scan of the sphere."""
    input:
        substrate=lambda w: FILES.mirrored_scan_path(w.surface, int(w.scan)),
        spheres=FILES.mirrored_scan_paths(SELECTION.sphere),
    output:
        STORE.pull_off,
    params:
        parameters=SETTINGS["pull_off"],
    script:
        "../scripts/compute_pull_off.py"


rule aggregate_adhesion:
    """Gather the pull-off forces of all sphere scans on all substrate scans: adhesion.nc."""
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
