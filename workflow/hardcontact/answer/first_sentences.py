"""The start of the answer of each surface: its band and force, and what own forces say."""

import numpy as np
import xarray as xr

from hardcontact.answer.datasets import Datasets
from hardcontact.answer.fit_curve import of_answer
from hardcontact.answer.sentences import capital, differing_sides, one_sentence, transition_words
from hardcontact.numbers.printing import print_bounded, print_length, print_share
from hardcontact.numbers.statistics import bounds

#: The upper end of an interval is called open where it lies this many times farther, in the
#: logarithm, than the lower one: the scatter of few tests may be much larger than it appears.
LOPSIDED = 2.0
#: J/m², to part diamond along (111): no known solids adhere more strongly. Source: J. E. Field, The
#: Properties of Diamond (Academic Press, 1979).
STRONGEST = 10.6


def measured_sentences(fit: xr.Dataset | None) -> dict[str, str]:
    """Return, by surface with own forces, what they mean, and what all of them together mean."""
    if fit is None:
        return {}
    of_model = of_answer(fit)
    surfaces = of_model["surface"].values.tolist()
    text = capital(str(of_model["fit_text"].item()))
    if len(surfaces) > 1:
        text = (
            f"The forces measured on {len(surfaces)} surfaces together: {of_model.fit_text.item()}"
        )
    return {surface: f"{_measured(of_model.sel(surface=surface))} {text}." for surface in surfaces}


def _measured(fit: xr.Dataset) -> str:
    """Return the force measured on one surface and its work of adhesion at the range asked for."""
    asked, tests = fit.attrs["range_of_adhesion"], int(fit["tests"].item())
    here = fit.sel(rho=asked, method="nearest")
    continued = "".join(
        f", or {print_bounded(fit.sel(side=side), 'continued_work', 'J m-2')} if the roughness "
        f"goes on {transition_words(fit, side)}"
        for side in differing_sides(fit)
    )
    return (
        f"Measured, by its own forces: {print_bounded(fit, 'measured_force', 'N')} "
        f"({tests} {'test' if tests == 1 else 'tests'}{_open_above(fit)}), which means a work of "
        f"adhesion of {_work(here)} at a range of {print_length(asked)}{continued}."
        f"{_beyond_solids(here)}"
    )


def _beyond_solids(here: xr.Dataset) -> str:
    """Return that a work of adhesion is larger than any known, if it is."""
    if here["work_of_adhesion"].item() <= STRONGEST:
        return ""
    return " No known solids adhere so strongly: is the unit of the forces right?"


def _open_above(fit: xr.Dataset) -> str:
    """Return why the interval of a measured force reaches so far up, if it does."""
    low, high = (np.log(end.item()) for end in bounds(fit, "measured_force"))
    value = np.log(fit["measured_force"].item())
    # An interval that is not known is not lopsided.
    if high - value > LOPSIDED * (value - low):
        return ", too few to tell how they scatter: the upper end is uncertain"
    return ""


def fit_sentences(fit: xr.Dataset) -> str:
    """Return what the user's own forces say about range and work of adhesion.

    Parameters
    ----------
    fit : xarray.Dataset
        Part of fit.nc of one contact model: `measured_force` in N with its interval, `tests`,
        `label` and `interval_note` (surface), `work_of_adhesion` (surface, rho), `fit_text`,
        `continued_work` and `continued_differs` (surface, side), `transition` (side).

    Returns
    -------
    str
        Plain text.
    """
    surfaces = [fit.sel(surface=surface) for surface in fit["surface"].values]
    forces = ", ".join(
        f"{print_bounded(one, 'measured_force', 'N')} on {one['label'].item()} "
        f"({one['interval_note'].item()}{_open_above(one)})"
        for one in surfaces
    )
    text = f"Measured: {forces}. {capital(str(fit['fit_text'].item()))}."
    works = "; ".join(_works(one) for one in surfaces)
    return f"{text} {works}. Brackets: {print_share(fit.attrs['confidence'])} intervals."


def _works(fit: xr.Dataset) -> str:
    """Return the works of adhesion of one surface: at the range asked for and at the ends."""
    asked = fit.attrs["range_of_adhesion"]
    here = fit.sel(rho=asked, method="nearest")
    text = f"{fit['label'].item()}: {_work(here)} at the range of {print_length(asked)} asked for"
    for side in differing_sides(fit):
        continued = print_bounded(fit.sel(side=side), "continued_work", "J m-2")
        text += (
            f", or {continued} there if the roughness goes on {transition_words(fit, side)} as its "
            "spectrum does, because the work is the measured force over the computed one"
        )
    first, last = (
        f"{_work(end)} at {print_length(end['rho'].item())}"
        for end in (fit.isel(rho=0), fit.isel(rho=-1))
    )
    return f"{text}; from {first} to {last} over all ranges computed"


def _work(fit: xr.Dataset) -> str:
    """Return the work of adhesion that fits at one range, as printed."""
    return print_bounded(fit, "work_of_adhesion", "J m-2")


def first_sentences(given: Datasets) -> dict[str, str]:
    """Return by surface what an answer begins with: one sentence, and what own forces say."""
    measured = measured_sentences(given.fit)
    texts = {}
    for surface, label in given.labels().items():
        of = given.of_surface(surface)
        predicted = one_sentence(label, of.edges, of.force)
        texts[surface] = " ".join(filter(None, (predicted, measured.get(surface))))
    return texts
