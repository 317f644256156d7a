# Forces that others measured, beside what the closed form says of them.

from hardcontact.config.experiments import EXPERIMENTS, EXPERIMENTS_SCHEMA, PRIORS


rule weigh_experiments:
    """Hold the closed form to published experiments, what they do not state drawn: ledger.nc."""
    input:
        experiments=EXPERIMENTS,
        schema=EXPERIMENTS_SCHEMA,
        priors=PRIORS,
        validation="resources/validation/prediction.csv",
        code=code_inputs("weigh_experiments.py"),
    output:
        PATTERNS.dataset("ledger"),
    log:
        PATTERNS.log("weigh_experiments"),
    benchmark:
        PATTERNS.benchmark("weigh_experiments")
    params:
        canonical=canonical({"seed": STUDY["seed"], "confidence": STUDY["inference"]["confidence"]}),
    script:
        "../scripts/weigh_experiments.py"


rule ledger:
    """Hold the closed form to published experiments, and draw the figure of them."""
    input:
        rules.weigh_experiments.output,
        rules.draw_fig_ledger.output,
