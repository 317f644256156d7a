# Description of a study: its configuration, and the list of its variables.
# Names in capitals that are not defined here: common.smk.

#: The final datasets of the rules that the Snakefile includes before this file. Datasets with wildcards
#: are left out, because other rules gather them.
FINAL_DATASETS = [
    path
    for dataset_rule in workflow.rules
    for path in dataset_rule.output
    if path.startswith(f"{RESULTS.results}/") and path.endswith(".nc") and "{" not in path
]


rule describe_study:
    """Keep the configuration and the table of surfaces, and list the variables of all datasets."""
    input:
        surfaces=STUDY["surfaces"],
        datasets=sorted(FINAL_DATASETS),
        template="workflow/report/templates/datasets.md",
    output:
        configuration=RESULTS.result("configuration.yaml"),
        surfaces=RESULTS.result("surfaces.tsv"),
        variables=RESULTS.result("datasets.md"),
    params:
        parameters=config,
    script:
        "../scripts/describe_study.py"
