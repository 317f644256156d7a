# Claims: each statement of the paper beside what was computed.

from hardcontact.paper.evaluation import DATASETS, INSIGHT_DATASETS

for verdicts, datasets in {"claims": DATASETS, "insight_claims": INSIGHT_DATASETS}.items():

    rule:
        """Judge statements of the paper by what was computed: claims.csv, insight_claims.csv."""
        name:
            f"evaluate_{verdicts}"
        input:
            **{dataset: PATTERNS.dataset(dataset) for dataset in datasets},
            sets=rules.judge_sets.output[0],
            claims=f"resources/paper/{verdicts}.csv",
            published_constants=PUBLISHED_TABLES["published_constants"],
            code=code_inputs("evaluate_claims.py"),
        output:
            claims=PATTERNS.result(f"{verdicts}.csv"),
        log:
            PATTERNS.log(f"evaluate_{verdicts}"),
        benchmark:
            PATTERNS.benchmark(f"evaluate_{verdicts}")
        params:
            canonical=canonical(
                {
                    "datasets": datasets,
                    "confidence": STUDY["inference"]["confidence"],
                    "seed": STUDY["seed"],
                }
            ),
        script:
            "../scripts/evaluate_claims.py"
