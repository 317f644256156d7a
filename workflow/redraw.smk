"""Make the figures and pages of a finished study again, from its datasets, without its store."""

from hardcontact.run import ending, preparation, reruns
from hardcontact.records.code import write_pins

preparation.prepare_run(workflow)


configfile: preparation.finished_configuration(config)


include: "rules/common.smk"


write_pins()  # surfaces.smk, which writes them in a whole run, is not included here.


if IS_PAPER_STUDY:

    report: "report/workflow.rst"

    include: "rules/answer_paper.smk"

else:

    report: "report/own_surfaces.rst"

    include: "rules/answer_surfaces.smk"


include: "rules/targets.smk"


preparation.complete_rules(workflow, RESULTS)


onstart:
    preparation.refuse_unwritable_folders(RESULTS.results)
    reruns.refuse_edited_inputs(workflow)


onsuccess:
    ending.log_answer(workflow, RESULTS.result("answer.html"))


onerror:
    ending.log_how_to_resume(workflow)


rule redraw:
    """Draw all figures and write all pages of a finished study again."""
    default_target: True
    input:
        [TARGETS[target] for target in ("figures", "pages", "answer") if target in TARGETS],
