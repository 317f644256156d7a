# Asperities: the patches that carry the force of a contact.


rule find_asperities:
    """Find the patches that carry most of the force of a sample of contacts of one scan."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=PATTERNS.stitched_sphere,
        code=code_inputs("find_asperities.py"),
    output:
        PATTERNS.asperities,
    params:
        parameters=lambda w: parameters(
            surface=w.surface,
            scan=int(w.scan),
            contact=CONTACT,
            asperities=STUDY["asperities"],
            seed=STUDY["seed"],
        ),
    script:
        "../scripts/find_asperities.py"


rule aggregate_asperities:
    """Gather the patches of all scans: asperities.nc."""
    input:
        scans=FILES.paths(PATTERNS.asperities, FILES.pairs_in_turn),
        code=code_inputs("aggregate_asperities.py"),
    output:
        PATTERNS.dataset("asperities"),
    params:
        parameters=parameters(scan_keys=FILES.substrate_scans, **NAMED_SURFACES),
    script:
        "../scripts/aggregate_asperities.py"
