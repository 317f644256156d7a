# Claims: each statement of the paper beside what was computed.

from hardcontact.paper.evaluation import DATASETS, INSIGHT_DATASETS


rule evaluate_claims:
    """Judge each statement of the paper by what was computed: claims.csv."""
    input:
        **{name: PATTERNS.dataset(name) for name in DATASETS},
        sets=rules.judge_sets.output[0],
        claims="resources/paper/claims.csv",
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("evaluate_claims.py"),
    output:
        claims=PATTERNS.result("claims.csv"),
    log:
        PATTERNS.log("evaluate_claims"),
    benchmark:
        PATTERNS.benchmark("evaluate_claims")
    params:
        canonical=canonical(
            {
                "datasets": DATASETS,
                "confidence": STUDY["inference"]["confidence"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/evaluate_claims.py"


rule evaluate_insight_claims:
    """Judge the statements of the paper on which the chapter has the numbers: insight_claims.csv."""
    input:
        **{name: PATTERNS.dataset(name) for name in INSIGHT_DATASETS},
        sets=rules.judge_sets.output[0],
        claims="resources/paper/insight_claims.csv",
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("evaluate_claims.py"),
    output:
        claims=PATTERNS.result("insight_claims.csv"),
    log:
        PATTERNS.log("evaluate_insight_claims"),
    benchmark:
        PATTERNS.benchmark("evaluate_insight_claims")
    params:
        canonical=canonical(
            {
                "datasets": INSIGHT_DATASETS,
                "confidence": STUDY["inference"]["confidence"],
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/evaluate_claims.py"


rule claims:
    """Make the verdicts on the paper's statements."""
    input:
        rules.evaluate_claims.output,
