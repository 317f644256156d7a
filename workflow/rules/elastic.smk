# Elastic contact: pressure at the preload, and pull-off beside that of rigid bodies.


rule solve_elastic_contact:
    """Solve elastic contact, without and with adhesion, of a sample of contacts of one scan."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=PATTERNS.stitched_sphere,
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("solve_elastic_contact.py"),
    output:
        PATTERNS.elastic,
    params:
        parameters=lambda w: parameters(
            surface=w.surface,
            scan=int(w.scan),
            contact=CONTACT,
            contacts=STUDY["elastic"]["contacts"],
            seed=STUDY["seed"],
        ),
    script:
        "../scripts/solve_elastic_contact.py"


rule aggregate_elastic:
    """Gather elastic contact of all scans: elastic.nc."""
    input:
        scans=FILES.paths(PATTERNS.elastic, FILES.pairs_in_turn),
        code=code_inputs("aggregate_elastic.py"),
    output:
        PATTERNS.dataset("elastic"),
    params:
        parameters=parameters(scan_keys=FILES.substrate_scans, **NAMED_SURFACES),
    script:
        "../scripts/aggregate_elastic.py"
