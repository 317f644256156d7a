# Masters: scans with artificial roughness, and forces on them without the waves beyond each cutoff.
# Names in capitals that are not defined here: common.smk and surfaces.smk.

from hardcontact.config.keys import SMOOTH_SPHERE
from hardcontact.files.settings import largest_master_megabytes
from hardcontact.surfaces.synthesis import SIDES

EDGE_CHUNKS = CHUNKS.master_forces("edges")
#: Masters of sampled spectra, which your surfaces alone have.
SAMPLED_CHUNKS = [] if IS_PAPER_STUDY else CHUNKS.master_forces("sampled")


rule synthesize_masters:
    """Make a master of the purpose `edges` for each side: a scan with random waves beyond the side's transition."""
    input:
        scan=lambda w: FILES.contact_map_path(
            w.surface, PLAN.master_scan_number(w.surface, int(w.realization))
        ),
        spectrum=lambda w: FILES.contact_spectrum_path(w.surface),
    output:
        **{side: STORE.masters.replace("{side}", side) for side in SIDES},
    resources:
        # The settings of `edges` give the pixels of surfaces in contact. Masters have no more.
        mem_mb=largest_master_megabytes(SETTINGS["edges"]),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            realization=int(w.realization),
            **SETTINGS["masters"],  # seed, sides
        ),
    script:
        "../scripts/synthesize_masters.py"


# `w.purpose` is one of the purposes in hardcontact/files/purposes.py, of which ../README.md has a table and
# an example. The rule reads masters or makes them:
#   edges           reads the masters that synthesize_masters wrote. Inputs: short_masters, long_masters
#   other purposes  makes each master and forgets it. Inputs: scans, spectra
# It is one rule, because its name is in the records of all these forces.
rule compute_filtered_forces:
    """Compute the forces on masters of a purpose, unfiltered and without waves beyond each cutoff."""
    input:
        unpack(lambda w: CHUNKS.master_inputs(w.purpose, w.surface, int(w.first), int(w.last))),
        sphere=lambda w: [] if w.sphere_digest == SMOOTH_SPHERE else FILES.first_sphere_scan_path,
    output:
        STORE.master_forces,
    resources:
        mem_mb=lambda w: largest_master_megabytes(SETTINGS[w.purpose]),
    params:
        parameters=lambda w: dict(
            surface=w.surface,
            realization_numbers=list(range(int(w.first), int(w.last) + 1)),
            # seed, window, stream, contacts_per_row, sides, radii, loadings, ranges
            **SETTINGS[w.purpose],
        ),
    script:
        "../scripts/compute_filtered_forces.py"


rule aggregate_filtered_forces:
    """Gather the forces on all filtered masters of the band: filtered_forces.nc."""
    input:
        master_forces=FILES.paths(STORE.master_forces, EDGE_CHUNKS),
        sampled_master_forces=FILES.paths(STORE.master_forces, SAMPLED_CHUNKS),
    output:
        RESULTS.dataset("filtered_forces"),
    params:
        parameters=dict(
            surfaces=[chunk.surface for chunk in EDGE_CHUNKS],
            sampled_surfaces=[chunk.surface for chunk in SAMPLED_CHUNKS],
            loading=PLAN.contact.loading_name,
            **LABELS_AND_SOURCES,
            rho=STUDY["adhesion"]["range"],
            sphere_radius=STUDY["sphere"]["radius"],
            transitions={side: STUDY["band"][side]["transition"] for side in SIDES},
        ),
    script:
        "../scripts/aggregate_filtered_forces.py"
