# Claims: each statement of the paper beside what was computed.

from hardcontact.paper.evaluation import DATASETS


rule evaluate_claims:
    """Judge statements of the paper by what was computed: claims.csv."""
    input:
        **{dataset: PATTERNS.dataset(dataset) for dataset in DATASETS},
        sets=rules.judge_sets.output[0],
        claims="resources/paper/claims.csv",
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("evaluate_claims.py"),
    output:
        claims=PATTERNS.result("claims.csv"),
    retries: 0  # A fault of a statement would be there again.
    params:
        canonical=parameters(datasets=DATASETS, confidence=STUDY["inference"]["confidence"]),
    script:
        "../scripts/evaluate_claims.py"
