# One contact of the study, drawn in Fig. 4a.

# The paper does not say which: it is in the middle of the first scans of the reference surface.
TRACED = {
    **named(STUDY["reference_surface"]),
    "scan": SELECTION.scans(STUDY["reference_surface"])[0],
    "sphere_scan": SELECTION.scans(SPHERE)[0],
    "contact_index": [STUDY["contact"]["contacts_per_row"] // 2] * 2,
}


rule trace_contact:
    """Trace gap, adhesive pressure and force over separation of one contact: contact.nc."""
    input:
        substrate=FILES.stitched_path(TRACED["surface"], TRACED["scan"]),
        sphere=FILES.stitched_path(SPHERE, TRACED["sphere_scan"]),
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("trace_contact.py"),
    output:
        PATTERNS.dataset("contact"),
    params:
        parameters=parameters(**TRACED, contact=CONTACT),
    script:
        "../scripts/trace_contact.py"
