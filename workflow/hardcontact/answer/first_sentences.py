"""The start of the answer of each surface: its band and its force, and what was measured of it."""

from hardcontact.answer.datasets import Datasets
from hardcontact.answer.fit_sentences import measured_sentences
from hardcontact.answer.sentences import one_sentence

__all__ = ["first_sentences"]


def first_sentences(given: Datasets) -> dict[str, str]:
    """Return what an answer begins with, by surface.

    Parameters
    ----------
    given : Datasets
        Of the study.

    Returns
    -------
    dict of str to str
        Plain text: one sentence, and of own forces what they say of range and work of adhesion.
    """
    measured = measured_sentences(given.fit)
    texts = {}
    for surface, label in given.labels().items():
        of = given.of_surface(surface)
        predicted = one_sentence(label, of.edges, of.force)
        texts[surface] = " ".join(filter(None, (predicted, measured.get(surface))))
    return texts
