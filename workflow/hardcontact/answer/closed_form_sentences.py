"""What the closed form of the pull-off force comes to, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import (
    DIGITS,
    labels,
    listed,
    print_bounded_as_paper,
    print_within,
)
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS, SMOOTH, at_transition
from hardcontact.statistics import bounds
from hardcontact.surfaces.masters import SIDES

__all__ = ["closed_form_sentences"]

AT_TRANSITION = "transition"

#: What a regime means, before the names of the surfaces that are in it.
MEANING = {
    SMOOTH: "the roughness hardly counts",
    MANY_POINTS: "the whole surface attracts, so that the mean over all its points decides",
    AT_TRANSITION: "the surface is at the transition from many points to single peaks",
    SINGLE_PEAKS: "the few highest summits carry the force",
}
#: What the ratio of a regime is compared with.
LIMIT = "single peaks decide beyond 1"
NEAR_LIMIT = (
    "near 1 m/σ and σ/ρ differ by less than one, and the highest point, at m, lies within one "
    "standard deviation of the heights that attract most"
)


def closed_form_sentences(closed_form: xr.Dataset, band: xr.Dataset) -> list[str]:
    """Return how far the closed form can be trusted, who is in which regime, and the edges.

    Parameters
    ----------
    closed_form : xarray.Dataset
        As from `closed_form_errors.closed_form_errors`, with `label(surface)`.
    band : xarray.Dataset
        Computed edges, as from `critical_band.critical_band`.

    Returns
    -------
    list of str
        The answer first.
    """
    largest = closed_form.isel(map_size=-1).sel(source="spectrum")
    return [
        _accuracy(largest),
        _first_term(largest),
        *_regimes(closed_form, largest),
        _edges(closed_form, band),
    ]


def _accuracy(largest: xr.Dataset) -> str:
    half = np.exp(np.median(abs(np.log(largest["error"].values))))
    first, last = (print_as_paper(rho.item(), "nm") for rho in largest["rho"][[0, -1]])
    size = print_as_paper(largest["map_size"].item(), "nm")
    return (
        f"From the spectrum alone, the closed form gives the mean pull-off force within a factor "
        f"of {half:.3g} of that computed on random surfaces of {size}, in half of "
        f"{largest['error'].size} cases ({largest.sizes['surface']} surfaces, ranges of adhesion "
        f"from {first} to {last}). {_worst(largest)}"
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
        f"It is farthest off on {worst['label'].item()} at {print_as_paper(rho, 'nm')}: {ratio} "
        "times the computed force, with the interval of that; as the largest of many ratios this "
        "is no bound."
    )


def _first_term(largest: xr.Dataset) -> str:
    share = largest["first_term_force"] / largest["computed_force"]
    return (
        "Its first term alone, the mean over all points of the surface, gives between "
        f"{share.min().item():.{DIGITS}g} and {share.max().item():.{DIGITS}g} times the computed "
        "force: the summits that touch and the plastic contact area make up the rest."
    )


def _regimes(closed_form: xr.Dataset, largest: xr.Dataset) -> list[str]:
    rho = closed_form.attrs["range_of_adhesion"]
    at_range, of_map = closed_form.sel(rho=rho), largest.sel(rho=rho)
    # As freezing is σ²/(mρ).
    level = (of_map["predicted_approach"] / (of_map["freezing"] * rho)) ** 0.5
    between = at_transition(level * at_range["whole_freezing"], level)
    regimes = at_range["regime"].where(~between | (at_range["regime"] == SMOOTH), AT_TRANSITION)
    said = []
    for regime, meaning in MEANING.items():
        within = at_range.isel(surface=(regimes == regime).values)
        if within.sizes["surface"]:
            names = labels(within, within["surface"].values.tolist())
            freezing = listed(f"{value:.{DIGITS}g}" for value in within["whole_freezing"].values)
            limit = NEAR_LIMIT if regime == AT_TRANSITION else LIMIT
            said.append(
                f"With all scales and at a range of {print_as_paper(rho, 'nm')}, {meaning} on "
                f"{names} ((σ/ρ)/(m/σ) = {freezing}; {limit})."
            )
    return said


def _edges(closed_form: xr.Dataset, band: xr.Dataset) -> str:
    named = []
    for surface in closed_form["surface"].values:
        of_surface, computed = closed_form.sel(surface=surface), band.sel(group=surface)
        short, long = (
            f"{_edge(of_surface.sel(side=side))} (computed: {_computed(computed.sel(side=side))})"
            for side in SIDES
        )
        named.append(f"{of_surface['label'].item()} {short} and {long}")
    return f"The short and the long edge of the band that it predicts: {'; '.join(named)}."


def _edge(of_side: xr.Dataset) -> str:
    return print_as_paper(of_side["edge"].item(), "nm", digits=DIGITS) or "no edge"


def _computed(of_side: xr.Dataset) -> str:
    edge = print_bounded_as_paper(of_side, "critical_wavelength", "nm")
    return "no edge" if of_side["critical_wavelength"].isnull() else edge
