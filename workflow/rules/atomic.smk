# Atomic scale: a master of four times the study's pixels, beside these. No part of the study.

from hardcontact.figures.catalogue import OF_ATOMIC
from hardcontact.config.grids import master_megabytes
from hardcontact.config.patterns import STUDY_VARIANT

SMALL_SCALES = STUDY["scales"]["small"]
FINER_PIXELS = 4 * SMALL_SCALES["pixels"]
# Longer cutoffs concern no finer pixel.
SHORT_CUTOFFS = [
    cutoff for cutoff in SMALL_SCALES["cutoffs"] if cutoff <= 4 * SMALL_SCALES["transition"]
]


rule compare_finer_master:
    """Compare the force without the shortest waves on finer and finer pixels: atomic.nc."""
    input:
        scan=FILES.stitched_of_realization(STUDY["reference_surface"], 1, STUDY_VARIANT),
        spectrum=FILES.spectrum(STUDY["reference_surface"]),
        code=code_inputs("compare_finer_master.py"),
    output:
        PATTERNS.dataset("atomic"),
    log:
        PATTERNS.log("compare_finer_master"),
    benchmark:
        PATTERNS.benchmark("compare_finer_master")
    resources:
        mem_mb=master_megabytes(FINER_PIXELS, 3000),
    params:
        canonical=canonical(
            {
                "surface": STUDY["reference_surface"],
                "label": SELECTION.labels[STUDY["reference_surface"]],
                "basis": SELECTION.basis[STUDY["reference_surface"]],
                "seed": STUDY["seed"],
                "transition": SMALL_SCALES["transition"],
                "compared": {
                    "pixels": [SMALL_SCALES["pixels"], FINER_PIXELS],
                    "cutoffs": SHORT_CUTOFFS[::2],  # each takes a minute on 32768 pixels
                    "radius": STUDY["sphere"]["radius"],
                    "rho": STUDY["scales"]["range"],
                    "contact": STUDY["contact"],
                    "tolerance": STUDY["scales"]["tolerance"],
                    "confidence": STUDY["inference"]["confidence"],
                },
            }
        ),
    script:
        "../scripts/compare_finer_master.py"


rule atomic:
    """Compare the study's pixels with finer ones, and draw it: takes minutes and much memory."""
    input:
        [getattr(rules, f"draw_{name}").output for name in OF_ATOMIC],
