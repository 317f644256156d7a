# Rules for the user's surfaces: add the sphere's roughness, test the extrapolation (hindcast), find
# edges, compute the force, fit range and work.

from hardcontact.files.patterns import any_name_pattern

COMBINED_SURFACES = any_name_pattern(PLAN.combined_surfaces)


rule combine_scans:
    """Add the roughness of a scan of the sphere, at a random position, to that of a substrate."""
    input:
        substrate=STORE.mirrored_substrates,
        sphere=lambda w: FILES.mirrored_scan_path(SPHERE, PLAN.sphere_scan(w.surface, int(w.scan))),
    output:
        STORE.combined_scans,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            scan=int(w.scan),
            sphere_scan=PLAN.sphere_scan(w.surface, int(w.scan)),
            **SETTINGS["both_bodies"],
        ),
    script:
        "../scripts/combine_scans.py"


rule combine_spectra:
    """Add the spectrum of the sphere to that of a substrate."""
    input:
        substrate=lambda w: FILES.spectrum_path(w.surface),
        sphere=lambda w: FILES.spectrum_path(SPHERE),
    output:
        STORE.combined_spectra,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/combine_spectra.py"


rule combine_sampled_spectra:
    """Add a sampled spectrum of the sphere to one of a substrate."""
    input:
        substrate=STORE.sampled_spectra.replace("{shape}", "flat"),
        sphere=lambda w: FILES.path(STORE.sampled_spectra, SPHERE, realization=w.realization),
    output:
        STORE.combined_sampled_spectra,
    wildcard_constraints:
        surface=COMBINED_SURFACES,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/combine_sampled_spectra.py"


rule aggregate_spectra:
    """Gather the spectra of all surfaces, measured or described: spectra.nc."""
    input:
        spectra=[FILES.roughness_spectrum_path(surface) for surface in SELECTION.surfaces],
    output:
        RESULTS.dataset("spectra"),
    params:
        parameters=dict(
            surfaces=SELECTION.surfaces,  # the order of the inputs
            labels=SELECTION.labels,
            descriptions={
                surface: SELECTION.description(surface) for surface in SELECTION.substitutes
            },
        ),
    script:
        "../scripts/aggregate_spectra.py"


rule sample_spectra:
    """Sample a spectrum for each realization, within what the measurements of a surface leave open."""
    input:
        measurements=lambda w: FILES.measurement_paths(w.surface),
    output:
        expand(
            STORE.sampled_spectra,
            realization=range(1, STUDY["scales"]["realizations"] + 1),
            allow_missing=True,
        ),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            contact_scan_indices=SELECTION.contact_scan_indices(w.surface),
            tip_radii=SELECTION.tip_radii(w.surface),
            sphere_radius=PLAN.sphere_radius(w.surface),
            **SETTINGS["sampled_spectra"],
        ),
    script:
        "../scripts/sample_spectra.py"


rule compute_hindcast_forces:
    """Compute the forces on a scan with its outermost octave replaced, and with wider pixels."""
    input:
        mirrored=lambda w: FILES.mirrored_map_path(w.surface, int(w.scan)),
        spectrum=lambda w: FILES.roughness_spectrum_path(w.surface),
        body_spectra=lambda w: [
            FILES.spectrum_path(body.surface) for body in PLAN.rough_bodies(w.surface, int(w.scan))
        ],
        sphere=SPHERE_SCAN,
    output:
        STORE.hindcast,
    params:
        parameters=lambda w: dict(
            scan=int(w.scan),
            bodies=PLAN.rough_bodies(w.surface, int(w.scan)),
            measurements=PLAN.measurements_of_map(w.surface, int(w.scan)),
            **SETTINGS["hindcast"],
        ),
    script:
        "../scripts/compute_hindcast_forces.py"


if PLAN.measured_scan_ids:

    rule aggregate_hindcast:
        """Gather the tests whether forces on scans may be extrapolated: hindcast.nc."""
        input:
            forces=FILES.paths(STORE.hindcast, PLAN.measured_scan_ids),
        output:
            RESULTS.dataset("hindcast"),
        params:
            parameters=dict(
                scans=PLAN.measured_scan_ids,
                **LABELS_AND_SOURCES,
                tolerance=STUDY["scales"]["tolerance"],
                rho=STUDY["adhesion"]["range"],
                confidence=STUDY["intervals"]["confidence"],
            ),
        script:
            "../scripts/aggregate_hindcast.py"


#: The tests of measured scans; substitutes have none.
HINDCAST = RESULTS.dataset("hindcast") if PLAN.measured_scan_ids else []
#: The scans of masters, and how forces on them are compared.
MASTER_PARAMETERS = {
    "scan_counts": {name: len(SELECTION.contact_scans(name)) for name in SELECTION.substrates},
    "tiles": STUDY["scales"]["long"]["tiles"],
    "tolerance": STUDY["scales"]["tolerance"],
    "confidence": STUDY["intervals"]["confidence"],
}


# Intervals are over parts of scans, because masters share few scans. `find_edges_of_masters` needs
# independent masters.
rule find_edges_of_scans:
    """Find the edges of the critical band of the user's surfaces: edges.nc."""
    input:
        adhesion=RESULTS.dataset("adhesion"),
        scales=RESULTS.dataset("scales"),
        hindcast=HINDCAST,
    output:
        RESULTS.dataset("edges"),
    params:
        parameters=MASTER_PARAMETERS,
    script:
        "../scripts/find_edges_of_scans.py"


rule compute_force_at_pair:
    """Compute the force at one range and work, also with extrapolated roughness: force.nc."""
    input:
        adhesion=RESULTS.dataset("adhesion"),
        scales=RESULTS.dataset("scales"),
        topography=RESULTS.dataset("topography"),
        spectra=RESULTS.dataset("spectra"),
        hindcast=HINDCAST,
    output:
        RESULTS.dataset("force"),
    params:
        parameters=dict(
            contact=CONTACT
            | {"rho": STUDY["adhesion"]["range"], "work": STUDY["adhesion"]["work"]},
            **MASTER_PARAMETERS,
        ),
    script:
        "../scripts/compute_force_at_pair.py"


if HAS_FORCES:

    # One force permits a curve of pairs, a few a region; `fit_published` finds the best pair.
    rule fit_measured:
        """Find all pairs of range and work of adhesion that the user's forces permit: fit.nc."""
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
