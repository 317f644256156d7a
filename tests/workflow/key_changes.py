"""Another value of every key of the configuration, and the rules that it concerns."""

from rule_graph import (
    AGGREGATED,
    BEYOND,
    BEYOND_AT_RANGES,
    FILTERED,
    FORCES,
    FROM_SCANS,
    INFERRED,
    MASTER_LARGE,
    MASTER_SMALL,
    MASTERS,
    OF_SPECTRA,
    POOLED,
    SCANS,
    SPECTRA,
)

#: What a substitute that robustness makes otherwise runs through.
MADE_OTHERWISE = {"synthesize_scan", "prepare_scan", "vary_adhesion", "vary_scales"}

#: What reads spectra and no scan.
CLOSED, WINDOWS = "compare_closed_form", "try_scan_sizes"
#: Windows without their long waves.
SHORT = "filter_windows"
#: Masters that the edges of the band are scaled by, and the edges.
SCALED, EDGES = "compute_scaled_pull_off", "scale_edges"

#: What the elastic constants concern.
ELASTIC = {"solve_elastic_contact", "estimate_elastic_limit"}

#: Another value of every key, and the rules that it concerns. Every value also stands in the
#: configuration kept with the results and on the page of parameters.
KEYS = {
    "study": ("second", AGGREGATED | BEYOND | {"trace_contact", "measure_indents", "infer"}),
    "store": ("results/other", FROM_SCANS | SPECTRA | OF_SPECTRA),
    "surfaces": ("config/same.tsv", set()),
    "scans": ([1, 2, 3], FROM_SCANS | {"condition_scans"}),
    "quick": ({"seed": 3}, set()),
    "reference_surface": ("ncd", {"aggregate_topography", "aggregate_robustness", "infer",
                                  "compare_laws"}),
    "seed": (1, FROM_SCANS | OF_SPECTRA | {"condition_scans", EDGES, *INFERRED}),
    "sphere.surface": ("mcd", FROM_SCANS - POOLED | OF_SPECTRA | {"condition_scans"}),
    "sphere.radius": ("300 um", SCANS | FORCES | OF_SPECTRA | {EDGES}),
    "scan.pixels": (112, FROM_SCANS | {"condition_scans"}),
    "scan.size": ("2400 nm", FROM_SCANS | {"condition_scans", WINDOWS}),
    "scan.realization_pixels": (256, FROM_SCANS | {"condition_scans"}),
    "scan.undefined_pixels": ("harmonic", set()),  # substitutes have none
    "scan.levelling": ("lines", set()),
    "topography.slope": ("profile", FROM_SCANS | SPECTRA | OF_SPECTRA),
    "topography.curvature": ("laplacian", FROM_SCANS | SPECTRA | OF_SPECTRA),
    "contact.hardness": ("30 GPa", FORCES - {"map_forces"} | OF_SPECTRA | {SCALED}),
    "contact.preload": ("12 uN", FORCES - {"measure_indents", "map_forces"} | OF_SPECTRA | {EDGES}),
    "contact.window": ("12000 nm", FORCES | OF_SPECTRA | {SCALED}),
    "contact.count": (5, FORCES - {"vary_adhesion", "vary_scales", "compute_pool",
                                   "compute_law_forces"}),
    "adhesion.work": ("50 mJ/m2", set()),  # of own surfaces alone
    "adhesion.ranges": (["1 nm", "3 nm", "5.6 nm"],
                        {"compute_pull_off", "vary_adhesion", *POOLED}),
    "adhesion.traced_contact.surface": ("ncd", {"trace_contact"}),
    "adhesion.traced_contact.scan": (2, {"trace_contact"}),
    "adhesion.traced_contact.sphere_scan": (2, {"trace_contact"}),
    "adhesion.traced_contact.contact": ([2, 3], {"trace_contact"}),
    "inference.error_threshold": (0.2, {"infer", "aggregate_robustness", "judge_sets"}),
    "inference.force_floor": ("20 nN", {"infer", "judge_sets"}),
    "inference.samples": (120, INFERRED | {EDGES}),
    "inference.confidence": (0.9, INFERRED | BEYOND | {"aggregate_topography"}),
    # The forces of scans are computed at this range too.
    "scales.range": ("5 nm", {"compute_pull_off", "vary_adhesion", *POOLED,
                              "measure_window_change", *FILTERED, "compute_law_forces",
                              *BEYOND_AT_RANGES, EDGES, SHORT}),
    "scales.tolerance": (0.2, {"find_critical_band", "aggregate_robustness", "judge_sets",
                               CLOSED, "compare_laws", EDGES, WINDOWS}),
    "scales.realizations": (3, {*MASTERS, "compute_filtered_pull_off", "judge_sets"}),
    "scales.sphere_roughness": (True, FILTERED),
    "scales.small.pixels": (2048, {MASTER_SMALL, "compute_filtered_pull_off"}),
    "scales.small.transition": ("90 nm", {MASTER_SMALL, *FILTERED, "compute_law_forces",
                               SCALED}),
    "scales.small.cutoffs": (["43 nm", "80 nm", "120 nm", "500 nm"],
                             {"compute_filtered_pull_off", CLOSED}),
    "scales.large.pixels": (2048, {"compute_filtered_pull_off"}),
    "scales.large.tiles": (3, {MASTER_LARGE, *FILTERED}),
    "scales.large.transition": ("900 nm", {MASTER_LARGE, *FILTERED, "compute_law_forces",
                               SCALED}),
    "scales.large.cutoffs": (["500 nm", "1800 nm", "4000 nm", "5000 nm"],
                             {"compute_filtered_pull_off", CLOSED}),
    "elastic.sphere.modulus": ("360 GPa", ELASTIC),
    "elastic.sphere.poisson_ratio": (0.3, ELASTIC),
    "elastic.substrate.modulus": ("1000 GPa", ELASTIC),
    "elastic.substrate.poisson_ratio": (0.2, ELASTIC),
    "elastic.contacts": (2, {"solve_elastic_contact"}),
    "elastic.window": ("2400 nm", {"solve_elastic_contact"}),
    "indent.surface": ("mcd", {"measure_indents", "repeat_contact"}),
    "indent.preloads": (["20 uN"], {"measure_indents"}),
    "asperities.contacts": (3, {"find_asperities"}),
    "asperities.share": (0.8, {"find_asperities"}),
    "asperities.ranges": (["1 nm", "2 nm"], {"find_asperities"}),
    "robustness.preloads": (["6 uN"], {"vary_adhesion", "vary_scales"}),
    "robustness.hardnesses": (["16 GPa"], {"vary_adhesion", "vary_scales"}),
    "sets.replicates": (3, {"judge_sets"}),
    "sets.pool": (12, {"compute_pool"}),
    "sets.amplitudes": (5, {"compute_pool"}),
    "sets.count": (5, {"vary_adhesion", "vary_scales", "compute_pool"}),
    "sets.realizations": (3, {"judge_sets"}),
    "sets.small.pixels": (2048, {"vary_scales"}),
    "sets.small.cutoffs": (["43 nm", "120 nm"], {"vary_scales"}),
    "sets.large.pixels": (2048, {"vary_scales"}),
    "sets.large.cutoffs": (["500 nm", "1800 nm"], {"vary_scales"}),
    "insight.realizations": (1, {CLOSED, "compare_laws", "aggregate_repeated_contact"}),
    "insight.count": (3, {CLOSED, "compute_law_forces"}),
    "insight.ranges": (["1 nm", "5.6 nm"], {CLOSED, "map_forces"}),
    "insight.mean_error": (0.1, {"map_forces"}),
    "insight.pixels": (128, {CLOSED}),
    "insight.sizes": (["4 um"], {CLOSED}),
    "insight.spacing": ("0.2 nm", {"compare_laws"}),
    "insight.reach": ("18 um", {"compute_law_forces"}),
    "insight.orders": (1, {"repeat_contact"}),
    "insight.small.pixels": (1024, {"compute_law_forces"}),
    "insight.small.cutoffs": (["43 nm", "120 nm"], {"compute_law_forces"}),
    "insight.large.pixels": (2048, {"compute_law_forces"}),
    "insight.large.tiles": (1, {"compute_law_forces"}),
    "insight.large.cutoffs": (["500 nm", "1800 nm"], {"compute_law_forces"}),
    "insight.scaling.radii": (["125 um", "250 um"], {SCALED}),
    "insight.scaling.ranges": (["2.8 nm", "5.6 nm"], {SCALED}),
    "insight.scaling.preloads": (["10 uN", "40 uN"], {SCALED}),
    "insight.scaling.count": (3, {SCALED}),
    "insight.scaling.realizations": (1, {EDGES}),
    "insight.scaling.small.pixels": (1024, {SCALED}),
    "insight.scaling.small.cutoffs": (["43 nm", "120 nm"], {SCALED}),
    "insight.scaling.large.pixels": (1024, {SCALED}),
    "insight.scaling.large.tiles": (1, {SCALED}),
    "insight.scaling.large.cutoffs": (["500 nm", "1800 nm"], {SCALED}),
    "insight.scan_sizes.size": ("12 um", {SHORT}),
    "insight.scan_sizes.pixels": (128, {SHORT}),
    "insight.scan_sizes.realizations": (1, {WINDOWS}),
    "insight.scan_sizes.spectra": (7, {WINDOWS}),
    "insight.scan_sizes.radii": (["250 um"], {WINDOWS}),
    "insight.scan_sizes.sizes": (["2500 nm"], {SHORT}),
    "insight.scan_sizes.windows": (1, {WINDOWS}),
    "insight.scan_sizes.ranges": (["5.6 nm"], {WINDOWS}),
    "insight.scan_sizes.count": (4, {SHORT}),
    "insight.scan_sizes.excess": (1.2, {WINDOWS}),
    "insight.scan_sizes.edges.size": ("24 um", {SHORT}),
    "insight.scan_sizes.edges.realizations": (1, {SHORT}),
    "insight.scan_sizes.edges.windows": (2, {SHORT}),
    "insight.scan_sizes.edges.cutoffs": (["500 nm", "3000 nm"], {SHORT}),
}  # fmt: skip

#: Keys that make another study of measured surfaces, changed by tests/workflow/test_own_reruns.py.
KEYS_OF_OWN_SURFACES = {"published", "forces"}

#: The same of keys that concern the variants of robustness alone, whose masters no set draws.
KEYS_OF_VARIANTS = {
    "robustness.heights.surface": ("mcd", MADE_OTHERWISE),
    "robustness.heights.skewness": ([0.1], MADE_OTHERWISE),
    "robustness.tip.surface": ("mcd", MADE_OTHERWISE),
    "robustness.tip.radii": (["20 nm"], MADE_OTHERWISE),
    "robustness.realizations": (2, {"vary_scales"}),
}
