# Single contacts: one as it separates, for Fig. 4a; elastic contacts; the indents that contacts leave in
# the sphere; the asperities that carry the force.
# Names in capitals that are not defined here: common.smk and surfaces.smk.
#
# `parameters` come from three places. A rule whose output is in the store takes SETTINGS, whose digest is
# in the path: `elastic` and `asperities`. A rule of a final file takes CONTACT_ARGUMENTS and keys of STUDY.
# SELECTION gives both the numbers of scans.

# The paper does not say which contact Fig. 4a shows. This one is in the middle of the array on the
# first scan of the reference surface, with the first scan of the sphere.
TRACED_CONTACT = {
    **SELECTION.attributes(STUDY["reference_surface"]),
    "scan": SELECTION.contact_scan_numbers(STUDY["reference_surface"])[0],
    "sphere_scan": SELECTION.contact_scan_numbers(SELECTION.sphere_surface)[0],
    "contact_index": [STUDY["contact"]["contacts_per_row"] // 2] * 2,  # row and column
}
#: The substrate whose contacts indent the sphere.
INDENTING_SURFACE = STUDY["indent"]["surface"]
#: All scans of a substrate, and for each the scan of the sphere that meets it.
SUBSTRATE_AND_SPHERE_SCANS = {
    "substrates": lambda w: FILES.mirrored_scan_paths(w.surface),
    "spheres": lambda w: [
        FILES.mirrored_scan_path(SELECTION.sphere_surface, PLAN.sphere_scan_number(w.surface, scan))
        for scan in SELECTION.contact_scan_numbers(w.surface)
    ],
}


rule trace_contact:
    """Trace gap, adhesive pressure and force over separation of one contact: contact.nc."""
    input:
        substrate=FILES.mirrored_scan_path(TRACED_CONTACT["surface"], TRACED_CONTACT["scan"]),
        sphere=FILES.mirrored_scan_path(SELECTION.sphere_surface, TRACED_CONTACT["sphere_scan"]),
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        RESULTS.dataset("contact"),
    params:
        parameters=dict(**TRACED_CONTACT, contact=CONTACT_ARGUMENTS),
    script:
        "../scripts/trace_contact.py"


rule solve_elastic_contacts:
    """Solve elastic contact, without and with adhesion, of a sample of contacts of one surface."""
    input:
        **SUBSTRATE_AND_SPHERE_SCANS,
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        STORE.elastic,
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            scans=SELECTION.contact_scan_numbers(w.surface),
            **SETTINGS["elastic"],  # seed, contact, contacts
        ),
    script:
        "../scripts/solve_elastic_contacts.py"


rule aggregate_elastic:
    """Gather elastic contact of all substrates: elastic.nc."""
    input:
        surfaces=[FILES.path(STORE.elastic, surface) for surface in SELECTION.substrates],
    output:
        RESULTS.dataset("elastic"),
    params:
        parameters=dict(
            surfaces=SELECTION.substrates,
            **LABELS_AND_SOURCES,
            title="elastic contacts: pressure at the preload, and pull-off beside that of rigid bodies",
        ),
    script:
        "../scripts/aggregate_contacts.py"


rule measure_indents:
    """Measure the indents that contacts on one surface leave in the sphere: indent.nc."""
    input:
        substrates=FILES.mirrored_scan_paths(INDENTING_SURFACE),
        spheres=FILES.mirrored_scan_paths(SELECTION.sphere_surface),
    output:
        RESULTS.dataset("indent"),
    params:
        parameters=dict(
            **SELECTION.attributes(INDENTING_SURFACE),
            scan_numbers=SELECTION.contact_scan_numbers(INDENTING_SURFACE),
            sphere_scan_numbers=SELECTION.contact_scan_numbers(SELECTION.sphere_surface),
            preloads=STUDY["indent"]["preloads"],
            contact=CONTACT_ARGUMENTS | {"preload": max(STUDY["indent"]["preloads"])},
        ),
    script:
        "../scripts/measure_indents.py"


rule find_asperities:
    """Find the asperities that carry most of the force of a sample of contacts of one surface."""
    input:
        **SUBSTRATE_AND_SPHERE_SCANS,
    output:
        STORE.asperities,
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            scans=SELECTION.contact_scan_numbers(w.surface),
            **SETTINGS["asperities"],  # seed, contact, asperities
        ),
    script:
        "../scripts/find_asperities.py"


rule aggregate_asperities:
    """Gather the asperities of all substrates: asperities.nc."""
    input:
        surfaces=[FILES.path(STORE.asperities, surface) for surface in SELECTION.substrates],
    output:
        RESULTS.dataset("asperities"),
    params:
        parameters=dict(
            surfaces=SELECTION.substrates,
            **LABELS_AND_SOURCES,
            title="asperities that carry the pull-off force of plastic contacts",
        ),
    script:
        "../scripts/aggregate_contacts.py"
