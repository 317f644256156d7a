"""What other laws of attraction come to, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import (
    DIGITS,
    EDGE_NAMES,
    listed,
    print_bounded_as_paper,
    print_percent,
)
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.claims.verdicts import verdict
from hardcontact.insight.interaction_laws import EXPONENTIAL, HAMAKER, POTENTIAL
from hardcontact.scales.critical_band import POOLED
from hardcontact.scales.cutoffs import computed_cutoffs
from hardcontact.statistics import bounds
from hardcontact.surfaces.masters import SIDES

__all__ = ["law_sentences"]


def law_sentences(laws: xr.Dataset) -> list[str]:
    """Return whether other laws would give similar results, and what measured forces say of them.

    Parameters
    ----------
    laws : xarray.Dataset
        As from `law_comparison.compare_laws`.

    Returns
    -------
    list of str
        The answer first.
    """
    others = [law for law in laws["law"].values if law != EXPONENTIAL.name]
    return [
        _verdicts(laws, others),
        _forces(laws, others),
        _edges(laws, others),
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


def _edges(laws: xr.Dataset, others: list[str]) -> str:
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
