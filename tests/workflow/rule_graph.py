"""The graph of rules: which of them make what again once others have."""

from hardcontact.figures.catalogue import FIGURES, OF_ATOMIC, OF_INSIGHT

# The rules of one stage

SPECTRA = {"calibrate_spectrum", "condition_scans"}
SCANS = {"synthesize_scan", "prepare_scan", "measure_topography", "aggregate_topography"}
MASTER_SMALL, MASTER_LARGE = "synthesize_small_scale_master", "synthesize_large_scale_master"
MASTERS = {MASTER_SMALL, MASTER_LARGE}
PAIRS = {
    "compute_pull_off", "measure_window_change", "solve_elastic_contact", "find_asperities",
    "vary_adhesion", "repeat_contact", "estimate_elastic_limit",
}  # fmt: skip
CONTACTS = PAIRS | {"trace_contact", "measure_indents", "compare_sphere"}
FILTERED = {"compute_filtered_pull_off", "vary_scales"}
#: What concerns substitutes with a published rms height alone.
POOLED = {"compute_pool", "compare_sphere"}
FORCES = CONTACTS | FILTERED | POOLED | {"compute_law_forces", "map_forces"}
FROM_SCANS = SCANS | MASTERS | FORCES | {"compute_scaled_pull_off"}
AGGREGATED = {
    "aggregate_topography", "aggregate_adhesion", "aggregate_elastic", "aggregate_asperities",
    "aggregate_scales", "aggregate_robustness", "judge_sets",
}  # fmt: skip
INFERRED = {
    "infer", "find_critical_band", "aggregate_robustness", "apply_classical_models",
    "compare_laws",
}  # fmt: skip
#: What shows every value of the configuration.
KEPT = {"keep_configuration", "describe_study", "answer_paper", "answer_insight"}
#: What makes the datasets of the chapter beyond the paper, at other ranges than the paper's or not.
BEYOND_AT_RANGES = {"compare_closed_form", "compare_laws", "map_forces"}
BEYOND = BEYOND_AT_RANGES | {
    "aggregate_repeated_contact", "aggregate_elastic_limit", "scale_edges", "try_scan_sizes",
}  # fmt: skip
#: What the chapter makes of spectra alone.
OF_SPECTRA = {"compare_closed_form", "filter_windows", "try_scan_sizes"}
#: What concerns measured surfaces alone.
OF_MEASURED = {
    "measure_spectrum", "aggregate_spectra", "find_band_edges", "predict_force", "fit_forces",
    "answer_surfaces",
}  # fmt: skip

DRAWN = {f"draw_{name}" for name in FIGURES}
#: What targets make that are no part of the study.
APART = {"compare_finer_master", *(f"draw_{name}" for name in OF_ATOMIC)}
#: The rules that make what figures are drawn from.
DATASETS = {
    "adhesion": "aggregate_adhesion", "asperities": "aggregate_asperities",
    "band": "find_critical_band", "classical": "apply_classical_models",
    "contact": "trace_contact", "elastic": "aggregate_elastic", "indent": "measure_indents",
    "inference": "infer", "robustness": "aggregate_robustness", "scales": "aggregate_scales",
    "sets": "judge_sets", "topography": "aggregate_topography",
    "closed_form": "compare_closed_form", "laws": "compare_laws", "maps": "map_forces",
    "repeated_contact": "aggregate_repeated_contact", "elastic_limit": "aggregate_elastic_limit",
    "scaling": "scale_edges", "scan_size": "try_scan_sizes",
}  # fmt: skip


def drawn_from(*names):
    """Return the rules that draw figures from any of these datasets or published tables."""
    return {f"draw_{name}" for name, figure in FIGURES.items() if set(names) & set(figure.inputs)}


#: What reads the file that a rule makes; intermediates are named in full by the tables below.
FOLLOWS = {
    "compute_pull_off": {"aggregate_adhesion"},
    "measure_window_change": {"aggregate_adhesion"},
    "solve_elastic_contact": {"aggregate_elastic"},
    "find_asperities": {"aggregate_asperities"},
    "compute_filtered_pull_off": {"aggregate_scales"},
    "vary_adhesion": {"aggregate_robustness"},
    "vary_scales": {"aggregate_robustness", "judge_sets"},
    "compute_pool": {"judge_sets"},
    "compare_sphere": {"judge_sets"},
    "judge_sets": {"answer_paper", "describe_study", "evaluate_claims"},
    "measure_topography": {"aggregate_topography"},
    "aggregate_topography": {"answer_paper", "judge_sets", "evaluate_claims"},
    "aggregate_adhesion": {"infer", "judge_sets", "evaluate_claims"},
    "aggregate_elastic": {"evaluate_claims", "aggregate_elastic_limit"},
    "measure_indents": {"evaluate_claims"},
    "aggregate_asperities": {"evaluate_claims"},
    "aggregate_scales": {"answer_paper", "find_critical_band", "evaluate_claims"},
    "find_critical_band": {"answer_insight", "answer_paper", "describe_study", "evaluate_claims"},
    "infer": {"apply_classical_models", "evaluate_claims"},
    "apply_classical_models": {"evaluate_claims"},
    "evaluate_claims": {"describe_study", "answer_paper"},
    "compute_law_forces": {"compare_laws"},
    "repeat_contact": {"aggregate_repeated_contact"},
    "estimate_elastic_limit": {"aggregate_elastic_limit"},
    "compute_scaled_pull_off": {"scale_edges"},
    "filter_windows": {"try_scan_sizes"},
    **{rule: {"answer_insight"} for rule in BEYOND},
    "compare_laws": {"answer_insight", "evaluate_claims"},
    "try_scan_sizes": {"answer_insight", "answer_paper"},
    **{
        f"draw_{name}": {"answer_insight" if name in OF_INSIGHT else "answer_paper"}
        for name in FIGURES
    },
}
for dataset, rule in DATASETS.items():
    FOLLOWS[rule] = FOLLOWS.get(rule, set()) | drawn_from(dataset)

#: What reads the intermediates, where all files of a rule are made again.
INTERMEDIATE = {
    "calibrate_spectrum": {
        "condition_scans",
        "synthesize_scan",
        "compute_pool",
        *MASTERS,
        "vary_scales",
        "aggregate_topography",
        *OF_SPECTRA,
        "scale_edges",
        "compute_scaled_pull_off",
        "compute_law_forces",
    },
    "condition_scans": {"synthesize_scan", "aggregate_topography"},
    "measure_spectrum": {
        *MASTERS,
        "vary_scales",
        "aggregate_topography",
        *OF_SPECTRA,
        "scale_edges",
        "compute_scaled_pull_off",
        "compute_law_forces",
    },
    "synthesize_scan": {"prepare_scan"},
    "prepare_scan": {
        "measure_topography",
        "aggregate_topography",
        *MASTERS,
        *CONTACTS,
        "vary_scales",
        "compute_law_forces",
        "compute_scaled_pull_off",
        "map_forces",
    },
    MASTER_SMALL: {"compute_filtered_pull_off"},
    MASTER_LARGE: {"compute_filtered_pull_off"},
}


def following(rules, graph=FOLLOWS):
    """Return the rules, what follows from them by the graph, and the description of the whole."""
    reached, pending = set(rules), list(rules)
    while pending:
        more = graph.get(pending.pop(), set()) - reached
        reached |= more
        pending += more
    return reached | ({"describe_crate"} if reached else set())


def all_following(rules):
    """Return the rules and what follows if all their files, intermediates too, are made again."""
    return following(rules, FOLLOWS | INTERMEDIATE)
