# The configuration, and the paths of final files.
#
# Names that the rules of several files use:
#   config         the configuration as written, with units: for records and captions
#   STUDY          the same as numbers: nested dictionaries, with quantities in nm, N, Pa and J/m²
#   RESULTS        the paths of the final files of the study
#   SAMPLING       the seed, the number of random samples and the confidence of intervals
#   IS_PAPER_STUDY whether results are compared with the paper; false for your surfaces
#   HAS_FORCES     whether your surfaces have a table of measured forces
#   PAGES          the category and the title of each page of the report
#   ANSWER         answer.html and answer.json
#   PUBLISHED_TABLES  the tables of the paper: published_constants, published_pull_off, published_table1
# surfaces.smk defines the names that depend on the table of surfaces. Each other file of rules uses the
# names that it defines itself. Only the Snakefile uses one of these, too: TARGETS of targets.smk.

from hardcontact.base.published import PUBLISHED_TABLES
from hardcontact.config.configuration import is_paper_study
from hardcontact.config.keys import NONE
from hardcontact.config.user_files import read_yaml
from hardcontact.files.paths import StudyPaths
from hardcontact.run import preparation

STUDY = preparation.complete_configuration(workflow, config)
RESULTS = StudyPaths(STUDY)
SAMPLING = STUDY["intervals"] | {"seed": STUDY["seed"]}
IS_PAPER_STUDY = is_paper_study(STUDY)
HAS_FORCES = STUDY["forces"] != NONE
PAGES = read_yaml("workflow/report/pages.yaml")
ANSWER = {
    "page": report(
        RESULTS.result("answer.html"),
        caption="../report/answer.rst",
        category="0. Results",
        labels={"page": "the answer"},
    ),
    "json": RESULTS.result("answer.json"),
}
