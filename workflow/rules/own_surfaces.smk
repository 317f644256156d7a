# Your surfaces: whether their scans may be extrapolated (hindcast), the edges of the band, the force,
# and the fit to measured forces.
# Names in capitals that are not defined here: common.smk and surfaces.smk.


rule compute_hindcast_forces:
    """Compute forces on a scan with its shortest or longest octave replaced, and on wider pixels."""
    input:
        mirrored=lambda w: FILES.contact_map_path(w.surface, int(w.scan)),
        spectrum=lambda w: FILES.contact_spectrum_path(w.surface),
        body_spectra=lambda w: [
            FILES.spectrum_path(body.surface)
            for body in PLAN.body_scan_ids(w.surface, int(w.scan))
        ],
        sphere=SPHERE_SCAN,
    output:
        STORE.hindcast,
    params:
        parameters=lambda w: dict(
            scan=int(w.scan),
            body_scans=PLAN.body_scan_ids(w.surface, int(w.scan)),
            measurement_indices=PLAN.measurement_indices(w.surface, int(w.scan)),
            **SETTINGS["hindcast"],  # seed, contact, transitions
        ),
    script:
        "../scripts/compute_hindcast_forces.py"


if PLAN.measured_scan_ids:

    rule aggregate_hindcast:
        """Gather the hindcasts, tests of the extrapolation within scans: hindcast.nc."""
        input:
            forces=FILES.paths(STORE.hindcast, PLAN.measured_scan_ids),
        output:
            RESULTS.dataset("hindcast"),
        params:
            parameters=dict(
                scan_ids=PLAN.measured_scan_ids,
                **LABELS_AND_SOURCES,
                tolerance=STUDY["band"]["tolerance"],
                rho=STUDY["adhesion"]["range"],
                confidence=STUDY["intervals"]["confidence"],
            ),
        script:
            "../scripts/aggregate_hindcast.py"


#: The hindcasts of measured scans; substitutes have none.
HINDCAST = RESULTS.dataset("hindcast") if PLAN.measured_scan_ids else []
#: How many scans the masters of each surface share, and how many mirrored scans per row a long-edge
#: master has, both for intervals; up to which relative change a force counts as unchanged.
MASTER_PARAMETERS = {
    "scan_counts": {
        name: len(SELECTION.contact_scan_numbers(name)) for name in SELECTION.substrates
    },
    "tiles": STUDY["band"]["long"]["tiles"],
    "tolerance": STUDY["band"]["tolerance"],
    "confidence": STUDY["intervals"]["confidence"],
}


# Masters share scans, so they are not independent, and intervals come from parts of the scans
# (`inference/scan_parts.py`). The paper's study has `find_edges_of_independent_masters` (edges.smk).
rule find_edges_of_shared_scans:
    """Find the edges of the band of your surfaces: edges.nc."""
    input:
        adhesion=RESULTS.dataset("adhesion"),
        filtered_forces=RESULTS.dataset("filtered_forces"),
        hindcast=HINDCAST,
    output:
        RESULTS.dataset("edges"),
    params:
        parameters=MASTER_PARAMETERS,
    script:
        "../scripts/find_edges_of_shared_scans.py"


rule compute_force_dataset:
    """Compute forces at the study's work of adhesion, also with extrapolated roughness: force.nc."""
    input:
        adhesion=RESULTS.dataset("adhesion"),
        filtered_forces=RESULTS.dataset("filtered_forces"),
        topography=RESULTS.dataset("topography"),
        spectra=RESULTS.dataset("spectra"),
        hindcast=HINDCAST,
    output:
        RESULTS.dataset("force"),
    params:
        parameters=dict(
            contact=CONTACT_ARGUMENTS
            | {"rho": STUDY["adhesion"]["range"], "work": STUDY["adhesion"]["work"]},
            **MASTER_PARAMETERS,  # scan_counts, tiles, tolerance, confidence
        ),
    script:
        "../scripts/compute_force_dataset.py"


if HAS_FORCES:

    # Forces on one surface give one work of adhesion for each range. Forces on several surfaces give a
    # region of pairs. In the paper's study `fit_published` (fits.smk) finds the best pair instead.
    rule fit_measured:
        """Find all pairs of range and work of adhesion that agree with your forces: fit.nc."""
        input:
            adhesion=RESULTS.dataset("adhesion"),
            force=RESULTS.dataset("force"),
            topography=RESULTS.dataset("topography"),
            forces=STUDY["forces"],
        output:
            RESULTS.dataset("fit"),
        params:
            parameters=SAMPLING,
        script:
            "../scripts/fit_measured.py"
