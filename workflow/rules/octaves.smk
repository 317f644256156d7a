# Octaves: how the force follows the amplitude of each, and the force on the band alone.

from hardcontact.config.files import SHORTEST_WHOLE_RANGE

CONTACT = STUDY["contact"] | {
    "radius": STUDY["sphere"]["radius"],
    "range": STUDY["scales"]["range"],
}
# Bands need whole surfaces: scans are too small for their long waves.
BAND_SURFACES = FILES.substitutes if COMPARED else []


rule compute_whole:
    """Compute the forces on whole substitute surfaces, also with each octave amplified."""
    input:
        description=lambda w: SELECTION.description(w.surface),
        tables=lambda w: SELECTION.tables(w.surface),  # named by the description
        spectrum=lambda w: FILES.spectrum(w.surface),
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("compute_whole.py"),
    output:
        PATTERNS.whole,
    log:
        PATTERNS.log("compute_whole", PATTERNS.whole),
    benchmark:
        PATTERNS.benchmark("compute_whole", PATTERNS.whole)
    params:
        canonical=lambda w: parameters(
            surface=w.surface,
            realizations=list(range(int(w.first), int(w.last) + 1)),
            seed=STUDY["seed"],
            grid=FILES.whole_grid,
            scan=SCAN_GRID,
            has_features=w.surface in FILES.featured,
            contact=CONTACT,
            ranges=[rho for rho in RANGES if rho >= SHORTEST_WHOLE_RANGE],
        ),
    script:
        "../scripts/compute_whole.py"


rule amplify_octaves:
    """Compute the forces on a measured scan with each octave of its waves amplified."""
    input:
        stitched=PATTERNS.stitched_substrate,
        sphere=FILES.first_sphere if SELECTION.scans(SPHERE) else [],
        code=code_inputs("amplify_octaves.py"),
    output:
        PATTERNS.octaves,
    log:
        PATTERNS.log("amplify_octaves", PATTERNS.octaves),
    benchmark:
        PATTERNS.benchmark("amplify_octaves", PATTERNS.octaves)
    params:
        canonical=lambda w: parameters(scan=int(w.scan), contact=CONTACT),
    script:
        "../scripts/amplify_octaves.py"


rule isolate_band:
    """Compute the forces on whole surfaces with the roughness of a band alone, and without."""
    input:
        description=lambda w: SELECTION.description(w.surface),
        tables=lambda w: SELECTION.tables(w.surface),  # named by the description
        spectrum=lambda w: FILES.spectrum(w.surface),
        edges=PATTERNS.dataset("edges"),
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("isolate_band.py"),
    output:
        PATTERNS.band_forces,
    log:
        PATTERNS.log("isolate_band/{surface}"),
    benchmark:
        PATTERNS.benchmark("isolate_band/{surface}")
    params:
        canonical=lambda w: parameters(
            surface=w.surface,
            realizations=list(range(1, STUDY["scales"]["whole_surfaces"] + 1)),
            seed=STUDY["seed"],
            grid=FILES.whole_grid,
            scan=SCAN_GRID,
            has_features=w.surface in FILES.featured,
            contact=CONTACT,
        ),
    script:
        "../scripts/isolate_band.py"


rule aggregate_sensitivity:
    """Gather how the force follows each octave, and the forces on the band: sensitivity.nc."""
    input:
        maps=[
            *FILES.paths(PATTERNS.whole, FILES.whole_chunks),
            *FILES.paths(PATTERNS.octaves, FILES.measured_scans),
        ],
        bands=[FILES.path(PATTERNS.band_forces, surface) for surface in BAND_SURFACES],
        adhesion=rules.aggregate_adhesion.output[0] if FILES.measured_scans else [],
        code=code_inputs("aggregate_sensitivity.py"),
    output:
        PATTERNS.dataset("sensitivity"),
    log:
        PATTERNS.log("aggregate_sensitivity"),
    benchmark:
        PATTERNS.benchmark("aggregate_sensitivity")
    params:
        canonical=parameters(
            maps=[*FILES.whole_chunks, *FILES.measured_scans],
            bands=BAND_SURFACES,
            **NAMED_SURFACES,
            radius=STUDY["sphere"]["radius"],
            rho=STUDY["scales"]["range"],
            confidence=STUDY["inference"]["confidence"],
        ),
    script:
        "../scripts/aggregate_sensitivity.py"
