"""What the closed form of the pull-off force comes to, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import DIGITS, labels, listed, print_within
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS, SMOOTH
from hardcontact.statistics import bounds
from hardcontact.surfaces.masters import SIDES

__all__ = ["closed_form_sentences"]

#: What a regime means, after the names of the surfaces that are in it.
MEANING = {
    SMOOTH: "the roughness hardly counts",
    MANY_POINTS: "the whole surface attracts, so that the mean over all its points decides",
    SINGLE_PEAKS: "the few highest summits carry the force",
}


def closed_form_sentences(closed_form: xr.Dataset) -> list[str]:
    """Return how far the closed form can be trusted, who is in which regime, and the edges.

    Parameters
    ----------
    closed_form : xarray.Dataset
        As from `closed_form_errors.closed_form_errors`, with `label(surface)`.

    Returns
    -------
    list of str
        The answer first.
    """
    largest = closed_form.isel(map_size=-1).sel(source="spectrum")
    return [_accuracy(largest), _worst(largest), _first_term(largest), *_regimes(closed_form),
            _edges(closed_form)]  # fmt: skip


def _accuracy(largest: xr.Dataset) -> str:
    distances = abs(np.log(largest["error"].values))
    most, half = np.exp([distances.max(), np.median(distances)])
    first, last = (print_as_paper(rho.item(), "nm") for rho in largest["rho"][[0, -1]])
    size = print_as_paper(largest["map_size"].item(), "nm")
    return (
        f"From the spectrum alone, the closed form gives the mean pull-off force within a factor "
        f"of {most:.3g}, in half of all cases within {half:.3g}, of that "
        f"computed on random surfaces of {size} ({largest.sizes['surface']} surfaces, ranges of "
        f"adhesion from {first} to {last})."
    )


def _worst(largest: xr.Dataset) -> str:
    error = largest["error"].stack(case=("surface", "rho"))
    surface, rho = error["case"][int(np.argmax(abs(np.log(error.values))))].item()
    worst = largest.sel(surface=surface, rho=rho)
    # The longer the computed force, the smaller the ratio to it.
    high, low = (worst["predicted_force"].item() / end.item()
                 for end in bounds(worst, "computed_force"))  # fmt: skip
    ratio = print_within(worst["error"].item(), low, high)
    return (
        f"It is farthest off on {worst['label'].item()} at {print_as_paper(rho, 'nm')}: "
        f"{ratio} times the computed force."
    )


def _first_term(largest: xr.Dataset) -> str:
    share = largest["first_term_force"] / largest["computed_force"]
    return (
        "Its first term alone, the mean over all points of the surface, gives between "
        f"{share.min().item():.{DIGITS}g} and {share.max().item():.{DIGITS}g} times the computed "
        "force: the summits that touch make up the rest."
    )


def _regimes(closed_form: xr.Dataset) -> list[str]:
    rho = closed_form.attrs["range_of_adhesion"]
    at_range = closed_form.sel(rho=rho)
    said = []
    for regime, meaning in MEANING.items():
        within = at_range.where(at_range["regime"] == regime, drop=True)
        if within.sizes["surface"]:
            names = labels(within, within["surface"].values.tolist())
            freezing = listed(f"{value:.{DIGITS}g}" for value in within["whole_freezing"].values)
            said.append(
                f"With all scales and at a range of {print_as_paper(rho, 'nm')}, {meaning} on "
                f"{names} ((σ/ρ)/(m/σ) = {freezing}; single peaks decide beyond 1)."
            )
    return said


def _edges(closed_form: xr.Dataset) -> str:
    named = []
    for surface in closed_form["surface"].values:
        of_surface = closed_form.sel(surface=surface)
        short, long = (
            print_as_paper(of_surface["edge"].sel(side=side).item(), "nm", digits=DIGITS)
            or "no edge"
            for side in SIDES
        )
        named.append(f"{of_surface['label'].item()} {short} and {long}")
    return f"The short and the long edge of the band that it predicts: {'; '.join(named)}."
