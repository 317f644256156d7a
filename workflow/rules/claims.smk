# Claims: each statement of the paper beside what was computed.
# Names in capitals that are not defined here: common.smk.

from hardcontact.base.published import CLAIMS
from hardcontact.paper.claims.statements import datasets_of_claims
from hardcontact.paper.changed_inputs import contact_inputs

CLAIM_DATASETS = datasets_of_claims(CLAIMS)


rule evaluate_claims:
    """Judge statements of the paper by what was computed: claims.csv."""
    input:
        **{dataset: RESULTS.dataset(dataset) for dataset in CLAIM_DATASETS},
        sets=RESULTS.dataset("sets"),
        claims=CLAIMS,
        published_constants=PUBLISHED_TABLES["published_constants"],
        published_table1=PUBLISHED_TABLES["published_table1"],
    output:
        claims=RESULTS.result("claims.csv"),
    retries: 0  # A faulty row of claims.csv fails again.
    params:
        parameters=dict(
            datasets=CLAIM_DATASETS,
            confidence=STUDY["intervals"]["confidence"],
            contact_inputs=contact_inputs(STUDY),
        ),
    script:
        "../scripts/evaluate_claims.py"
