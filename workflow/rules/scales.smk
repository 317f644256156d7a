# Scales: forces without the waves beyond each cutoff, and with each octave changed.

from hardcontact.config.limits import master_megabytes
from hardcontact.config.keys import SMOOTH_SPHERE
from hardcontact.files.settings import filter_megabytes
from hardcontact.surfaces.synthesis import SIDES

MASTERS = CHUNKS.filtered_masters("scales")
#: Masters of sampled spectra, which the user's surfaces alone have.
SAMPLED_MASTERS = [] if IS_PAPER_STUDY else CHUNKS.filtered_masters("sampled")


rule synthesize_masters:
    """Replace wavelengths of a scan beyond the transition of a side by random roughness."""
    input:
        scan=lambda w: FILES.contact_map_path(
            w.surface, PLAN.master_scan(w.surface, int(w.realization))
        ),
        spectrum=lambda w: FILES.contact_spectrum_path(w.surface),
    output:
        **{side: STORE.masters.replace("{side}", side) for side in SIDES},
    resources:
        mem_mb=master_megabytes(SETTINGS["masters"]["sides"]["short"]["pixels"]),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            realization=int(w.realization),
            **SETTINGS["masters"],
        ),
    script:
        "../scripts/synthesize_masters.py"


rule compute_filtered_forces:
    """Compute the forces of masters with all scales, and without those beyond each cutoff."""
    input:
        unpack(lambda w: CHUNKS.master_inputs(w.purpose, w.surface, int(w.first), int(w.last))),
        sphere=lambda w: [] if w.sphere_digest == SMOOTH_SPHERE else FILES.masters_sphere_path,
    output:
        STORE.filtered_masters,
    resources:
        mem_mb=lambda w: filter_megabytes(SETTINGS[w.purpose]),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            realizations=list(range(int(w.first), int(w.last) + 1)),
            **SETTINGS[w.purpose],
        ),
    script:
        "../scripts/compute_filtered_forces.py"


rule aggregate_scales:
    """Gather the forces of all filtered surfaces: scales.nc."""
    input:
        masters=FILES.paths(STORE.filtered_masters, MASTERS),
        sampled=FILES.paths(STORE.filtered_masters, SAMPLED_MASTERS),
    output:
        RESULTS.dataset("scales"),
    params:
        parameters=dict(
            surfaces=[row.surface for row in MASTERS],
            sampled_surfaces=[row.surface for row in SAMPLED_MASTERS],
            realizations=STUDY["scales"]["realizations"],
            loading=PLAN.contact.loading_name,
            **LABELS_AND_SOURCES,
            rho=STUDY["adhesion"]["range"],
            sphere_radius=STUDY["sphere"]["radius"],
            transitions={side: STUDY["scales"][side]["transition"] for side in SIDES},
        ),
    script:
        "../scripts/aggregate_scales.py"


rule compute_whole_surface_forces:
    """Compute the forces on whole substitute surfaces, also with each octave changed."""
    input:
        **DESCRIPTION_INPUTS,
        **SUBSTITUTE_INPUTS,
    output:
        STORE.whole_surfaces,
    params:
        parameters=lambda w: dict(
            **SETTINGS["whole_surfaces"],
            surface=w.surface,
            surface_numbers=list(range(int(w.first), int(w.last) + 1)),
            has_features=w.surface in PLAN.featured_surfaces,
        ),
    script:
        "../scripts/compute_whole_surface_forces.py"


rule compute_octave_forces:
    """Compute the forces on a scan with each octave changed."""
    input:
        mirrored=lambda w: FILES.contact_map_path(w.surface, int(w.scan)),
        sphere=SPHERE_SCAN,
    output:
        STORE.octave_forces,
    params:
        parameters=lambda w: dict(scan=int(w.scan), **SETTINGS["octave_forces"]),
    script:
        "../scripts/compute_octave_forces.py"


rule aggregate_sensitivity:
    """Gather how the force follows each octave: sensitivity.nc."""
    input:
        forces=[
            *FILES.paths(STORE.whole_surfaces, CHUNKS.whole_surfaces),
            *FILES.paths(STORE.octave_forces, PLAN.measured_scan_ids),
        ],
        adhesion=RESULTS.dataset("adhesion") if PLAN.measured_scan_ids else [],
    output:
        RESULTS.dataset("sensitivity"),
    params:
        parameters=dict(
            maps=[*CHUNKS.whole_surfaces, *PLAN.measured_scan_ids],
            **LABELS_AND_SOURCES,
            radius=STUDY["sphere"]["radius"],
            rho=STUDY["adhesion"]["range"],
            confidence=STUDY["intervals"]["confidence"],
        ),
    script:
        "../scripts/aggregate_sensitivity.py"
