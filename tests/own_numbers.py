"""The numbers of the answer of one own surface."""

from answer_inputs import datasets, setting

from hardcontact.report.own_answer import surface_answers


def numbers_of(own_setting=None, **others):
    """Numbers of the first surface, by name; `others` replace datasets."""
    return surface_answers(datasets(**others), own_setting or setting())[0].numbers
