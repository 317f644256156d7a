# Octaves: how the force follows the amplitude of each, and the force on the band alone.

from hardcontact.surfaces.synthesis import SIDES

#: The shortest range of adhesion (nm) on whole surfaces. These have peaks hundreds of nm above a
#: contact, and exp(height / range) overflows at 700 ranges, which are 490 nm for this range.
SHORTEST_WHOLE_RANGE = 0.7
#: Bands need whole surfaces: scans are too small for their long waves.
BAND_SURFACES = SELECTION.substitute_substrates if IS_PAPER_STUDY else []
#: The scan of the sphere; none if its roughness was added to that of the substrate.
SPHERE_SCAN = (
    FILES.first_sphere_path
    if SELECTION.contact_scans(SPHERE) and not PLAN.combined_surfaces
    else []
)
#: Parameters of whole surfaces, and of contacts on them.
WHOLE_SURFACES = {
    "seed": STUDY["seed"],
    "grid": PLAN.whole_surface_grid,
    "scan_grid": SCAN_GRID,
    "contact": CONTACT_AT_RANGE,
}


rule compute_whole_surface_forces:
    """Compute the forces on whole substitute surfaces, also with each octave amplified."""
    input:
        **DESCRIPTION_INPUTS,
        **SUBSTITUTE_INPUTS,
    output:
        PATTERNS.whole_surface_forces,
    params:
        parameters=lambda w: dict(
            **WHOLE_SURFACES,
            surface=w.surface,
            realizations=list(range(int(w.first), int(w.last) + 1)),
            has_features=w.surface in PLAN.featured_surfaces,
            ranges=[rho for rho in RANGES if rho >= SHORTEST_WHOLE_RANGE],
        ),
    script:
        "../scripts/compute_whole_surface_forces.py"


rule compute_perturbed_scan_forces:
    """Compute forces on a scan with octaves amplified, the last one replaced, and wider pixels."""
    input:
        stitched=lambda w: FILES.roughness_path(w.surface, int(w.scan)),
        spectrum=lambda w: FILES.roughness_spectrum_path(w.surface),
        body_spectra=lambda w: [
            FILES.spectrum_path(body.surface) for body in PLAN.rough_bodies(w.surface, int(w.scan))
        ],
        sphere=SPHERE_SCAN,
    output:
        PATTERNS.perturbed_scan_forces,
    params:
        parameters=lambda w: dict(
            scan=int(w.scan),
            bodies=PLAN.rough_bodies(w.surface, int(w.scan)),
            measurements=PLAN.measurements_of_map(w.surface, int(w.scan)),
            seed=STUDY["seed"],
            contact=CONTACT_AT_RANGE,
            transitions={side: STUDY["scales"][side]["transition"] for side in SIDES},
        ),
    script:
        "../scripts/compute_perturbed_scan_forces.py"


rule compute_band_forces:
    """Compute forces on whole surfaces with the band alone, without shorter and without longer waves."""
    input:
        **DESCRIPTION_INPUTS,
        **SUBSTITUTE_INPUTS,
        edges=PATTERNS.dataset("edges"),
    output:
        PATTERNS.band_forces,
    params:
        parameters=lambda w: dict(
            **WHOLE_SURFACES,
            surface=w.surface,
            realizations=list(range(1, STUDY["scales"]["whole_surfaces"] + 1)),
            has_features=w.surface in PLAN.featured_surfaces,
        ),
    script:
        "../scripts/compute_band_forces.py"


rule aggregate_sensitivity:
    """Gather how the force follows each octave, and the forces on the band: sensitivity.nc."""
    input:
        forces=[
            *FILES.paths(PATTERNS.whole_surface_forces, CHUNKS.whole_surfaces),
            *FILES.paths(PATTERNS.perturbed_scan_forces, PLAN.measured_scan_ids),
        ],
        bands=[FILES.path(PATTERNS.band_forces, surface) for surface in BAND_SURFACES],
        adhesion=PATTERNS.dataset("adhesion") if PLAN.measured_scan_ids else [],
    output:
        PATTERNS.dataset("sensitivity"),
    params:
        parameters=dict(
            maps=[*CHUNKS.whole_surfaces, *PLAN.measured_scan_ids],
            bands=BAND_SURFACES,
            **NAMED_SURFACES,
            radius=STUDY["sphere"]["radius"],
            rho=STUDY["adhesion"]["range"],
            tolerance=STUDY["scales"]["tolerance"],
            confidence=STUDY["inference"]["confidence"],
        ),
    script:
        "../scripts/aggregate_sensitivity.py"
