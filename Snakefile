"""Which scales of roughness matter for the adhesion of hard contacts: the study, end to end."""

# What these modules add to Snakemake: `preparation` gives each rule with a script a log and, if it writes
# files, a benchmark and an input `code`: the script and the modules that it imports. `ending` kills a run at
# Ctrl-C (on a cluster at the second), and prints the study's answer. `reruns` replaces seven attributes of
# Snakemake, named in `plan_by_records`, so that records in `.origin`, not file times, decide what runs again.
from hardcontact.run import ending, preparation, reruns

preparation.prepare_run(workflow)


configfile: "config/config.yaml"


# These two files define the names that rules share; each begins with a list of them.
include: "workflow/rules/common.smk"
include: "workflow/rules/surfaces.smk"
# The path of a height map: scans, contacts on them, forces by cutoff (masters) and by octave.
# For the user's surfaces, spectra are sampled, and the roughness of a scanned sphere is added.
include: "workflow/rules/scans.smk"


if not IS_PAPER_STUDY:

    include: "workflow/rules/spectra.smk"
    include: "workflow/rules/both_bodies.smk"


include: "workflow/rules/adhesion.smk"
include: "workflow/rules/masters.smk"
include: "workflow/rules/octaves.smk"


if IS_PAPER_STUDY:

    report: "workflow/report/workflow.rst"

    # Contacts in detail, the band, fits, sets, verdicts, figures and pages.
    include: "workflow/rules/single_contacts.smk"
    include: "workflow/rules/edges.smk"
    include: "workflow/rules/fits.smk"
    include: "workflow/rules/sets.smk"
    include: "workflow/rules/claims.smk"
    include: "workflow/rules/answer_paper.smk"

else:

    report: "workflow/report/own_surfaces.rst"

    # The band, the force and the fit, and the page.
    include: "workflow/rules/own_surfaces.smk"
    include: "workflow/rules/answer_surfaces.smk"


include: "workflow/rules/targets.smk"
# Last, because it lists the datasets of all rules before.
include: "workflow/rules/describe_study.smk"


preparation.complete_rules(workflow, RESULTS)


onstart:
    preparation.refuse_unwritable_folders(RESULTS.results, RESULTS.store)
    reruns.refuse_edited_inputs(workflow)
    ending.handle_interrupts(workflow)


onsuccess:
    ending.log_answer(workflow, RESULTS.result("answer.html"))


onerror:
    ending.log_how_to_resume(workflow)


rule all:
    """Make the datasets, verdicts, figures, pages and description of the study."""
    default_target: True
    input:
        TARGETS.values(),
        rules.describe_study.output,
