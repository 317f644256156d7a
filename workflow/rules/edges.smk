# The band of the paper's study: its edges, the force on the band alone, and how radius, load, plasticity
# and range of adhesion move the edges.
# Names in capitals that are not defined here: common.smk and surfaces.smk.

EXPONENT_CHUNKS = CHUNKS.master_forces("exponents")
EDGE_SHIFT_CHUNKS = CHUNKS.master_forces("edge_shifts")
#: Bands need whole surfaces: scans are too small for their long waves.
BAND_SURFACES = SELECTION.substitute_substrates
#: Not in the store, because the forces depend on the edges that the study found.
BAND_FORCES = RESULTS.dataset("band_forces/{surface}")


# Each master of a substitute has its own scan, so masters are independent, and intervals are over masters.
# The masters of `find_edges_of_shared_scans` (own_surfaces.smk) share scans.
rule find_edges_of_independent_masters:
    """Find the edges of the band of the paper's study: edges.nc."""
    input:
        filtered_forces=RESULTS.dataset("filtered_forces"),
    output:
        RESULTS.dataset("edges"),
    params:
        parameters=dict(tolerance=STUDY["band"]["tolerance"], sampling=SAMPLING),
    script:
        "../scripts/find_edges_of_independent_masters.py"


# For the published and the computed band, the parts are the waves in the band, all waves but shorter ones,
# and all waves but longer ones.
rule compute_band_forces:
    """Compute forces on whole surfaces with all waves, and with parts of them."""
    input:
        **DESCRIPTION_INPUTS,
        **SUBSTITUTE_INPUTS,
        edges=RESULTS.dataset("edges"),
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        BAND_FORCES,
    params:
        parameters=lambda w: dict(
            **SETTINGS["band_forces"],  # seed, scan_grid, featured_surface, contact, grid
            surface=w.surface,
            surface_numbers=list(range(1, STUDY["band"]["whole_surfaces"] + 1)),
            has_features=w.surface == PLAN.featured_surface,
        ),
    script:
        "../scripts/compute_band_forces.py"


rule aggregate_band_forces:
    """Gather the forces with parts of the roughness, relative to all of it: band_forces.nc."""
    input:
        surfaces=[FILES.path(BAND_FORCES, surface) for surface in BAND_SURFACES],
    output:
        RESULTS.dataset("band_forces"),
    params:
        parameters=dict(
            band_surfaces=BAND_SURFACES,
            surfaces=SELECTION.substrates,
            **LABELS_AND_SOURCES,
            radius=STUDY["sphere"]["radius"],
            rho=STUDY["adhesion"]["range"],
            confidence=STUDY["intervals"]["confidence"],
        ),
    script:
        "../scripts/aggregate_band_forces.py"


rule fit_exponents:
    """Fit exponents of forces and edges to radius and load: exponents.nc."""
    input:
        master_forces=FILES.paths(STORE.master_forces, EXPONENT_CHUNKS),
    output:
        RESULTS.dataset("exponents"),
    params:
        parameters=dict(
            surfaces=[chunk.surface for chunk in EXPONENT_CHUNKS],
            tolerance=STUDY["band"]["tolerance"],
            contact_area=PLAN.contact.area,
            confidence=STUDY["intervals"]["confidence"],
            **LABELS_AND_SOURCES,
        ),
    script:
        "../scripts/fit_exponents.py"


rule compute_edge_shifts:
    """Compute how far plasticity and a long range move the short edge: edge_shifts.nc."""
    input:
        master_forces=FILES.paths(STORE.master_forces, EDGE_SHIFT_CHUNKS),
    output:
        RESULTS.dataset("edge_shifts"),
    params:
        parameters=dict(
            surfaces=[chunk.surface for chunk in EDGE_SHIFT_CHUNKS],
            tolerance=STUDY["band"]["tolerance"],
            sampling=SAMPLING,
            **LABELS_AND_SOURCES,
        ),
    script:
        "../scripts/compute_edge_shifts.py"
