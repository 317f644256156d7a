# Scales: multi-scale masters, cutoff filters, pull-off of each filtered surface, the critical band.

from hardcontact.config.grids import master_megabytes
from hardcontact.surfaces.synthesis import SIDES

VARIED = [] if COMPARED else FILES.measured_masters


rule synthesize_small_scale_master:
    """Continue the roughness of a scan below its pixels."""
    input:
        scan=lambda w: FILES.stitched_of_realization(w.surface, int(w.realization), w.variant),
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("synthesize_small_scale_master.py"),
    output:
        PATTERNS.small_master,
    log:
        PATTERNS.log("synthesize_small_scale_master", PATTERNS.small_master),
    benchmark:
        PATTERNS.benchmark("synthesize_small_scale_master", PATTERNS.small_master)
    resources:
        mem_mb=master_megabytes(STUDY["scales"]["small"]["pixels"], 3000),
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "realization": int(w.realization),
                "seed": STUDY["seed"],
                "pixels": STUDY["scales"]["small"]["pixels"],
                "transition": STUDY["scales"]["small"]["transition"],
            }
        ),
    script:
        "../scripts/synthesize_small_scale_master.py"


rule synthesize_large_scale_master:
    """Continue the roughness of a scan beyond its size."""
    input:
        scan=lambda w: FILES.stitched_of_realization(w.surface, int(w.realization), w.variant),
        spectrum=lambda w: FILES.spectrum(w.surface, w.variant),
        code=code_inputs("synthesize_large_scale_master.py"),
    output:
        PATTERNS.large_master,
    log:
        PATTERNS.log("synthesize_large_scale_master", PATTERNS.large_master),
    benchmark:
        PATTERNS.benchmark("synthesize_large_scale_master", PATTERNS.large_master)
    resources:
        mem_mb=2000,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "realization": int(w.realization),
                "seed": STUDY["seed"],
                "tiles": STUDY["scales"]["large"]["tiles"],
                "transition": STUDY["scales"]["large"]["transition"],
            }
        ),
    script:
        "../scripts/synthesize_large_scale_master.py"


rule compute_filtered_pull_off:
    """Compute the forces of one master with all scales, and without those beyond each cutoff."""
    input:
        master=PATTERNS.master,
        sphere=FILES.first_sphere if STUDY["scales"]["sphere_roughness"] else [],
        code=code_inputs("compute_filtered_pull_off.py"),
    output:
        PATTERNS.filtered_pull_off,
    log:
        PATTERNS.log("compute_filtered_pull_off", PATTERNS.filtered_pull_off),
    benchmark:
        PATTERNS.benchmark("compute_filtered_pull_off", PATTERNS.filtered_pull_off)
    resources:
        mem_mb=lambda w: master_megabytes(STUDY["scales"][w.side]["pixels"], 3000),
    params:
        canonical=lambda w: canonical(
            {
                "side": w.side,
                "scales": {key: STUDY["scales"][w.side][key] for key in ("pixels", "cutoffs")},
                "radius": STUDY["sphere"]["radius"],
                "rho": STUDY["scales"]["range"],
                "contact": STUDY["contact"],
            }
        ),
    script:
        "../scripts/compute_filtered_pull_off.py"


rule aggregate_scales:
    """Gather the forces of all filtered surfaces: scales.nc."""
    input:
        masters=FILES.paths(PATTERNS.filtered_pull_off, FILES.masters),
        varied=FILES.paths(PATTERNS.varied_spectrum, VARIED),
        code=code_inputs("aggregate_scales.py"),
    output:
        PATTERNS.dataset("scales"),
    log:
        PATTERNS.log("aggregate_scales"),
    benchmark:
        PATTERNS.benchmark("aggregate_scales")
    params:
        canonical=canonical(
            {
                "masters": FILES.masters,
                "varied": VARIED,
                "load": FILES.contact.load,
                "labels": SELECTION.labels,
                "basis": SELECTION.basis,
                "rho": STUDY["scales"]["range"],
                "sphere_radius": STUDY["sphere"]["radius"],
                "transitions": {side: STUDY["scales"][side]["transition"] for side in SIDES},
            }
        ),
    script:
        "../scripts/aggregate_scales.py"


rule find_critical_band:
    """Find the wavelengths whose removal changes the force: band.nc."""
    input:
        scales=rules.aggregate_scales.output[0],
        code=code_inputs("find_critical_band.py"),
    output:
        PATTERNS.dataset("band"),
    log:
        PATTERNS.log("find_critical_band"),
    benchmark:
        PATTERNS.benchmark("find_critical_band")
    params:
        canonical=canonical(
            {
                "tolerance": STUDY["scales"]["tolerance"],
                "samples": STUDY["inference"]["samples"],
                "confidence": STUDY["inference"]["confidence"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/find_critical_band.py"


rule scales:
    """Make the forces of filtered surfaces, and the critical band or the edges of own surfaces."""
    input:
        rules.aggregate_scales.output,
        PATTERNS.dataset("band" if COMPARED else "edges"),
