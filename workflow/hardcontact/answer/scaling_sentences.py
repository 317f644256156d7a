"""What decides the edges of the critical band, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import EDGE_NAMES, NEAR_ONE, listed
from hardcontact.insight.closed_form import (
    MANY_POINTS,
    SINGLE_PEAKS,
    SMOOTH,
    TRANSITION,
    at_transition,
)
from hardcontact.insight.edge_regimes import CONTACT, RANGE, REACH, ROLL_OFF
from hardcontact.insight.edge_scaling import (
    DEPENDENCE,
    FALLING,
    INDEPENDENT,
    LENGTHS,
    PARTLY,
    PARTS,
    PROPORTIONAL,
    STEEPER,
    UNDECIDED,
    dependence,
)
from hardcontact.numbers.printing import (
    DIGITS,
    print_as_paper,
    print_bounded_as_paper,
    print_percent,
)
from hardcontact.numbers.statistics import bounds

#: Lengths as they are printed.
NAMES = dict(zip(LENGTHS, ("√R", "√ρ", "√(F/H)"), strict=True))
#: What `edge_scaling.dependence` says, in the words of the page.
WORDS = {
    PROPORTIONAL: "proportional",
    PARTLY: "partly",
    INDEPENDENT: "independent",
    STEEPER: "more than proportional",
    FALLING: "against it",
    UNDECIDED: "undecided",
}
RULE = (
    "An edge is called proportional to a length where the interval of the exponent holds 1 and not "
    "0, independent of it where it holds 0 and not 1, undecided where it holds both; where it "
    "holds neither, the edge follows partly (between 0 and 1), more than in proportion (above 1) "
    "or against the length (below 0)."
)
#: What a regime means for the force.
FORCE = {
    SMOOTH: "hardly depends on the roughness",
    MANY_POINTS: "is a Gaussian average over many points",
    SINGLE_PEAKS: "is frozen to single peaks",
}

REACH_IS_NO_END = (
    "The reach √(2Rρ) is where the attraction of a smooth sphere has fallen to 1/e of that at the "
    "middle, not where it ends: longer waves may count."
)


def scaling_sentences(scaling: xr.Dataset) -> list[str]:
    """Return what both edges follow, their exponents, the regimes, and how many edges there are.

    Parameters
    ----------
    scaling : xarray.Dataset
        As from `edge_scaling.edge_scaling`, with the variables of `edge_regimes.edge_regimes` and
        `edge_regimes.cause_exponents` at the sphere, range and load of the paper, and the
        attributes ``sphere_radius``, ``rho`` (nm) and ``area`` (nm²) of these.

    Returns
    -------
    list of str
        The answer first.
    """
    of_sides = (_followed(scaling, side) for side in EDGE_NAMES)
    exponents = (_exponents(scaling, side, length) for side in EDGE_NAMES for length in LENGTHS)
    return [
        f"{' '.join(of_sides)} Varied were {_varied(scaling)}.",
        RULE,
        *exponents,
        *(_of_reach(scaling, part) for part in PARTS[1:]),
        *_regimes(scaling),
        REACH_IS_NO_END,
        *_causes(scaling),
        _found(scaling),
    ]


def _each(scaling: xr.Dataset, name: str) -> str:
    """Return a number of every surface, with its interval."""
    return "; ".join(
        f"{of_surface['label'].item()} {print_bounded_as_paper(of_surface, name, '1')}"
        for of_surface in (scaling.sel(surface=surface) for surface in scaling["surface"].values)
    )


def _followed(scaling: xr.Dataset, side: str) -> str:
    of_side = scaling.sel(side=side, part=PARTS[0])
    lengths = []
    for length, name in NAMES.items():
        verdicts = of_side["dependence"].sel(length=length).values
        said = [
            f"{WORDS[verdict]} on {listed(of_side['label'].values[verdicts == verdict].tolist())}"
            for verdict in DEPENDENCE
            if (verdicts == verdict).any()
        ]
        lengths.append(f"{name} {', '.join(said)}")
    return f"How the {EDGE_NAMES[side]} edge of the band follows: {'; '.join(lengths)}."


def _varied(scaling: xr.Dataset) -> str:
    said = []
    for name, of in (("radius", "radii"), ("rho", "ranges"), ("area", "contact areas")):
        unit = "nm2" if name == "area" else "nm"
        first, last = (print_as_paper(scaling[name].values[end], unit) for end in (0, -1))
        said.append(f"{of} from {first} to {last}")
    return listed(said)


def _exponents(scaling: xr.Dataset, side: str, length: str) -> str:
    of_length = scaling.sel(side=side, part=PARTS[0], length=length)
    return (
        f"Exponent of the {EDGE_NAMES[side]} edge against {NAMES[length]}, 1 if it is "
        f"proportional and 0 if independent: {_each(of_length, 'exponent')}."
    )


def _of_reach(scaling: xr.Dataset, part: str) -> str:
    of_part = scaling.sel(side="large", part=part)
    return (
        f"Exponent of the long edge against the reach √(2Rρ) of the attraction, "
        f"{part.removeprefix('reach ')}: {_each(of_part, 'reach_exponent')}."
    )


def _regimes(scaling: xr.Dataset) -> list[str]:
    """Return what sets force and edges of each surface at sphere, range and load of the paper."""
    nearest = {"radius": scaling.attrs["sphere_radius"]} | {
        name: scaling.attrs[name] for name in ("rho", "area")
    }
    at_paper = scaling.sel(nearest, method="nearest")
    each = (at_paper.sel(surface=surface) for surface in scaling["surface"].values)
    return [
        f"At the paper's sphere, range and load the force on {one['label'].item()} {_force(one)}. "
        f"{_short_edge(one)}. {_long_edge(one)}."
        for one in each
    ]


def _causes(scaling: xr.Dataset) -> list[str]:
    """Return how the short edge scales where the contact is wider than it, and where not."""
    said = []
    for cause, where, alone in ((CONTACT, "wider", "contact"), (RANGE, "narrower", "rho")):
        of_cause = scaling.sel(cause=cause)
        follows = listed(_follows(of_cause.sel(length=length)) for length in LENGTHS)
        low, high = bounds(of_cause.drop_sel(length=alone), "cause_exponent")
        refuted = ~np.isin(dependence(low, high), [INDEPENDENT, UNDECIDED])
        so = f": not {NAMES[alone]} alone" if refuted.any() else ""
        said.append(f"Where it is {where} ({of_cause['cause_edges'].item()} edges), {follows}{so}.")
    return [
        "The closed form knows the range of adhesion, but not that a contact flattens what is "
        "smaller than itself. If only the wider of its short edge and the contact set the edge, "
        "this would follow √(F/H) alone where the contact is wider, and √ρ alone where it is "
        f"narrower. {' '.join(said)}",
        f"These intervals are a jackknife over {scaling.sizes['surface']} surfaces, and edges of "
        "one surface share its masters, so that they are no independent numbers.",
    ]


def _follows(of_length: xr.Dataset) -> str:
    """Return what an exponent of all surfaces says, in words and numbers."""
    low, high = bounds(of_length, "cause_exponent")
    verdict = WORDS[str(dependence(low, high))]
    exponent = print_bounded_as_paper(of_length, "cause_exponent", "1")
    return f"{NAMES[of_length['length'].item()]}: {verdict}, {exponent}"


def _nm(of_surface: xr.Dataset, name: str) -> str:
    return print_as_paper(of_surface[name].item(), "nm", digits=DIGITS)


def _computed(of_surface: xr.Dataset, side: str) -> str:
    return print_bounded_as_paper(of_surface.sel(side=side), "edge", "nm")


def _force(of_surface: xr.Dataset) -> str:
    regime = of_surface["regime"].item()
    if regime == SMOOTH:
        return FORCE[regime]
    sigma, m = (of_surface[name].item() for name in ("rough_height", "approach"))
    over_range, level = sigma / of_surface.attrs["rho"], m / sigma
    sign = ">" if over_range > level else "<"
    if at_transition(over_range, level):
        return (
            "is at the transition from many points to single peaks, since σ/ρ = "
            f"{over_range:.{NEAR_ONE}g} and m/σ = {level:.{NEAR_ONE}g} differ by less than "
            f"{TRANSITION:g}, a standard deviation of the heights that attract"
        )
    return (
        f"{FORCE[regime]}, since σ/ρ = {over_range:.{NEAR_ONE}g} {sign} m/σ = {level:.{NEAR_ONE}g}"
    )


def _short_edge(of_surface: xr.Dataset) -> str:
    computed = _computed(of_surface, "small")
    cause = of_surface["short_edge_from"].item()
    predicted = _nm(of_surface.sel(side="small"), "predicted_edge")
    diameter = f"The contact 2√(F/πH) = {_nm(of_surface, 'contact_diameter')}"
    if not cause:
        return f"The closed form has no short edge (computed: {computed})"
    compared = {CONTACT: "wider", RANGE: "narrower"}[cause]
    return (
        f"{diameter} is {compared} than its short edge of {predicted} in the closed form "
        f"(computed: {computed})"
    )


def _long_edge(of_surface: xr.Dataset) -> str:
    """Return whether the interval says that the shorter of roll-off and reach stops the edge."""
    lengths = {
        ROLL_OFF: f"the roll-off at {_nm(of_surface, 'roll_off')}",
        REACH: f"the reach √(2Rρ) = {_nm(of_surface, 'attraction_reach')}",
    }
    shorter = of_surface["long_edge_from"].item()
    (longer,) = lengths.keys() - {shorter}
    stop = min(of_surface["roll_off"].item(), of_surface["attraction_reach"].item())
    low, high = (end.item() for end in bounds(of_surface.sel(side="large"), "edge"))
    if low > stop:
        follows = "its interval lies wholly above, so that this length does not stop it"
    elif high < stop:
        follows = "its interval lies wholly below, so that the edge ends before this length"
    else:
        follows = "its interval does not exclude that this length stops it"
    return (
        f"Of {lengths[shorter]} and {lengths[longer]} the first is shorter; the computed long edge "
        f"is {_computed(of_surface, 'large')}: {follows}"
    )


def _found(scaling: xr.Dataset) -> str:
    number = scaling["edge"].isel(side=0, surface=0).size
    said = []
    for side, name in EDGE_NAMES.items():
        found = scaling["edges_found"].sel(side=side, part=PARTS[0]).values
        shares = zip(scaling["label"].values, found / number, strict=True)
        fewer = [f"{label} {print_percent(share)}" for label, share in shares if share < 1]
        if fewer:
            said.append(f"the {name} edge ({listed(fewer)})")
    if not said:
        return "Every combination has both edges."
    return (
        f"Not every combination has {listed(said)}: in the others no cutoff changes the force so "
        "much, and exponents say nothing of these."
    )
