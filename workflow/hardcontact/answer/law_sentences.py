"""What the closed form of the force and other laws of attraction come to, in plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import EDGE_NAMES, labels, listed
from hardcontact.claims.verdicts import verdict
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS, SMOOTH, at_transition
from hardcontact.insight.interaction_laws import EXPONENTIAL, HAMAKER, POTENTIAL
from hardcontact.numbers.printing import (
    DIGITS,
    print_as_paper,
    print_bounded_as_paper,
    print_percent,
    print_within,
)
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import POOLED, computed_cutoffs
from hardcontact.surfaces.synthesis import SIDES

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
    """Return how far the closed form can be trusted, who is in which regime, and the edges."""
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


def law_sentences(laws: xr.Dataset) -> list[str]:
    """Return whether other laws give similar results, and what measured forces say of them."""
    others = [law for law in laws["law"].values if law != EXPONENTIAL.name]
    return [
        _verdicts(laws, others),
        _forces(laws, others),
        _edges_of_law_sentences(laws, others),
        _strengths(laws, others),
        _fitted(laws),
        _atomic(laws),
        _window(laws, others),
    ]


def _name(laws: xr.Dataset, law: str) -> str:
    return str(laws["law_label"].sel(law=law).item())


def _judged(laws: xr.Dataset, law: str) -> str:
    """Return the verdict on forces that differ by less than the tolerance from those of Eq. 1."""
    of_law = laws.sel(law=law, case="equivalent")
    low, high = (end.item() for end in bounds(of_law, "fit_error"))
    limit = laws.attrs["scale_tolerance"]
    return verdict("below", of_law["fit_error"].item(), low, high, np.nan, limit)


def _verdicts(laws: xr.Dataset, others: list[str]) -> str:
    judged = "; ".join(f"{_name(laws, law)}, {_judged(laws, law)}" for law in others)
    return (
        "The paper expects similar results from other laws of attraction. Judged by whether the "
        "forces at their best range and work differ from those of its own law by less than "
        f"{print_percent(laws.attrs['scale_tolerance'])} in the mean over the surfaces: {judged}."
    )


def _forces(laws: xr.Dataset, others: list[str]) -> str:
    cases = laws.sel(case="equivalent")
    said = []
    for law in others:
        of_law = cases.sel(law=law)
        ends = (end.item() for end in bounds(of_law, "fit_error"))
        error = print_percent(of_law["fit_error"].item(), *ends)
        reach = print_bounded_as_paper(of_law, "range_of_law", "nm")
        work = print_bounded_as_paper(of_law, "work_of_adhesion", "J/m2")
        said.append(f"{_name(laws, law)} {error} (range {reach}, work {work})")
    own = " and ".join(
        print_as_paper(laws.attrs[name], unit)
        for name, unit in (("published_range", "nm"), ("published_work", "J/m2"))
    )
    return f"Their forces then differ from those at {own} on average by: {'; '.join(said)}."


def _edges_of_law_sentences(laws: xr.Dataset, others: list[str]) -> str:
    pooled = laws.sel(group=POOLED)
    said = []
    for law in others:
        short, long = (
            print_bounded_as_paper(pooled.sel(law=law, side=side), "edge_factor", "1")
            for side in SIDES
        )
        said.append(f"{_name(laws, law)} {short} and {long}")
    return (
        "The short and the long edge of the band, mean of all substrates, over those of Eq. 1: "
        f"{'; '.join(said)}. {_cutoffs(laws)}"
    )


def _cutoffs(laws: xr.Dataset) -> str:
    """Return how far neighbouring cutoffs of either side lie apart."""
    said = []
    for side, name in EDGE_NAMES.items():
        cutoffs = computed_cutoffs(laws["scale_ratio"].sel(side=side))
        apart = "" if len(cutoffs) < 2 else f", neighbours {_steps(cutoffs)} apart"
        said.append(f"{len(cutoffs)} at the {name} edge{apart}")
    return (
        f"Cutoffs are few ({'; '.join(said)}), and edges are interpolated between them, so that "
        "small changes of an edge may be those of the interpolation."
    )


def _steps(cutoffs: np.ndarray) -> str:
    steps = cutoffs[1:] / cutoffs[:-1]
    return f"factors of {steps.min():.{DIGITS}g} to {steps.max():.{DIGITS}g}"


def _strengths(laws: xr.Dataset, others: list[str]) -> str:
    strengths = laws["implied_over_known"].sel(case="equivalent")
    times = {law: strengths.sel(law=law).item() for law in others}
    hamaker, potential = HAMAKER * times["van_der_waals"], POTENTIAL * times["electrostatic"] ** 0.5
    # The energy of a capacitor goes with the square of its potential.
    references = {
        "van_der_waals": f"for a Hamaker constant of {HAMAKER:g} J, the upper end of those known "
        f"of solids: one of {hamaker:.{DIGITS}g} J",
        "retarded": "between perfect conductors",
        "electrostatic": f"for a contact potential of {POTENTIAL:g} V: one of "
        f"{potential:.{DIGITS}g} V",
    }
    said = "; ".join(
        f"{_name(laws, law)} {times[law]:.{DIGITS}g} times that {references[law]}" for law in others
    )
    return f"These ranges and works of adhesion take an attraction of this strength: {said}."


def _fitted(laws: xr.Dataset) -> str:
    fits = laws.sel(case="fitted")
    ranked = fits["law"].values[np.argsort(fits["fit_error"].values)]
    said = listed(
        f"{_name(laws, law)} {print_bounded_as_paper(fits.sel(law=law), 'fit_error', '1')}"
        for law in ranked
    )
    return (
        f"Mean relative errors where each law is fitted to the measured forces: {said}. The forces "
        f"are those of {laws.attrs['scans']} scans a surface with {laws.attrs['contacts']} "
        "contacts each, computed for this comparison; the study fits Eq. 1 to its own contacts, "
        "with another error."
    )


def _atomic(laws: xr.Dataset) -> str:
    fits = laws.sel(case="atomic")
    best = fits["law"].values[np.argmin(fits["fit_error"].values)]
    error = print_bounded_as_paper(fits.sel(law=best), "fit_error", "1")
    spacing = print_as_paper(laws.attrs["atomic_spacing"], "nm")
    return (
        f"At an atomic spacing of {spacing} none comes nearer to them than {error} "
        f"({_name(laws, best)})."
    )


def _window(laws: xr.Dataset, others: list[str]) -> str:
    growth = laws["window_growth"].sel(law=others)
    law = others[np.argmax(growth.max("surface").values)]
    return (
        "What lies beyond the window of these sums is left out; its second half raises the force "
        f"by at most {print_percent(growth.max().item())} ({_name(laws, law)})."
    )
