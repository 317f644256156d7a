"""The lists of files of the chapter on what decides the band."""

from itertools import product

from paper_numbers import SUBSTRATES, SURFACES
from small_study import PATTERNS, configuration, files, selection

from hardcontact.config.insight_files import InsightFiles


def insight_files(**changes):
    return InsightFiles(configuration(**changes), selection([1, 2, 4]), PATTERNS)


def test_realizations_are_the_first_scans_of_each_substrate(at_root):
    study = insight_files(insight__realizations=2)
    assert study.realized_scans == list(product(SUBSTRATES, [1, 2]))
    paths = study.of_scans(PATTERNS.law_scan)
    assert len(set(paths)) == len(study.realized_scans)
    assert [pair.scan for pair in study.repeated.values()] == [1, 2] * (len(SUBSTRATES) + 1)


def test_lists_of_all_files_are_those_of_the_study(at_root):
    ours, all_files = insight_files(insight__realizations=1), files([1, 2, 4])
    assert ours.scans == all_files.scans == list(product(SURFACES, [1, 2, 4]))
    assert ours.substrate_scans == all_files.substrate_scans
    assert ours.levelled_scans == all_files.levelled_scans
