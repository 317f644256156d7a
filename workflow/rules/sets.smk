# Sets, random choices of scans and masters: their numbers, surfaces with features, and the posterior.
# Names in capitals that are not defined here: common.smk and surfaces.smk.

from hardcontact.base.published import CLAIMS
from hardcontact.paper.claims.statements import claims_of_sets

# A set samples its scans of a substrate from a pool, takes a candidate, or keeps the scans of the study.
# It samples its masters, too: from those of the purpose `sets`, which are no part of a pool.
SET_CHUNKS = CHUNKS.master_forces("sets")


rule compute_pool:
    """Compute the forces on some scans of a pool, each scaled to several rms heights."""
    input:
        **SUBSTITUTE_INPUTS,
    output:
        STORE.pool,
    params:
        parameters=lambda w: dict(
            **SETTINGS["pool"],  # seed, scan_grid, contact, ranges, rms_height_count
            surface=w.surface,
            first=int(w.first),
            last=int(w.last),
            scan_count=len(SELECTION.contact_scan_numbers(w.surface)),
        ),
    script:
        "../scripts/compute_pool.py"


rule compute_featured_candidates:
    """Compute the forces on some candidates: surfaces with features that meet Table 1."""
    input:
        **SUBSTITUTE_INPUTS,
    output:
        STORE.featured_candidates,
    params:
        parameters=lambda w: dict(
            **SETTINGS["featured_candidates"],  # seed, scan_grid, contact, ranges
            surface=w.surface,
            first=int(w.first),
            last=int(w.last),
            scan_count=len(SELECTION.contact_scan_numbers(w.surface)),
            features=w.features,
        ),
    script:
        "../scripts/compute_featured_candidates.py"


rule sample_sets:
    """Sample all sets, and compute the quantities of each that the claims judge: sets.nc."""
    input:
        topography=RESULTS.dataset("topography"),
        adhesion=RESULTS.dataset("adhesion"),
        pools=FILES.paths(STORE.pool, CHUNKS.pools),
        candidates=FILES.paths(STORE.featured_candidates, CHUNKS.featured_candidates),
        master_forces=FILES.paths(STORE.master_forces, SET_CHUNKS),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        RESULTS.dataset("sets"),
    retries: 0  # A faulty row of claims.csv fails again.
    params:
        parameters=dict(
            pool_chunks=CHUNKS.pools,
            candidate_chunks=CHUNKS.featured_candidates,
            master_surfaces=[chunk.surface for chunk in SET_CHUNKS],
            # Masters of each substrate from which sets choose. Only `hardcontact compare` reads it.
            master_pool_size=STUDY["sets"]["masters"],
            loading=PLAN.contact.loading_name,
            claims=claims_of_sets(CLAIMS),
            settings={
                "seed": STUDY["seed"],
                "set_count": STUDY["sets"]["count"],
                "master_count": STUDY["band"]["masters"],  # in each set, as in the study
                "reference_surface": STUDY["reference_surface"],
                "tolerance": STUDY["band"]["tolerance"],
                "confidence": STUDY["intervals"]["confidence"],
            },
        ),
    script:
        "../scripts/sample_sets.py"


rule compare_features:
    """Compare the forces of surfaces with features with the published ones: features.nc."""
    input:
        sets=RESULTS.dataset("sets"),
        candidates=FILES.paths(STORE.featured_candidates, CHUNKS.featured_candidates),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        RESULTS.dataset("features"),
    params:
        parameters=dict(candidate_chunks=CHUNKS.featured_candidates, labels=SELECTION.labels),
    script:
        "../scripts/compare_features.py"


rule fit_posterior:
    """Compute how probable each pair of range and work is, given the published forces: posterior.nc."""
    input:
        sets=RESULTS.dataset("sets"),
        whole_surfaces=FILES.paths(STORE.whole_surfaces, CHUNKS.whole_surfaces),
        published_pull_off=PUBLISHED_TABLES["published_pull_off"],
    output:
        RESULTS.dataset("posterior"),
    params:
        parameters=dict(whole_surfaces=CHUNKS.whole_surfaces, sampling=SAMPLING),
    script:
        "../scripts/fit_posterior.py"
