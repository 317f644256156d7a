"""How large a scan must be, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import DIGITS, listed, print_bounded_as_paper, print_percent
from hardcontact.claims.quantity_text import print_as_paper

__all__ = ["scan_size_sentences"]


def scan_size_sentences(scan_size: xr.Dataset) -> list[str]:
    """Return how wrong forces on small scans are, the rule, its error, and the sizes needed.

    Parameters
    ----------
    scan_size : xarray.Dataset
        As `fig_scan_size.draw` takes it.

    Returns
    -------
    list of str
        The answer first.
    """
    at_range = scan_size.sel(rho=scan_size.attrs["rho"], method="nearest")
    return [_excess(at_range), _needed(at_range), _rule(scan_size), _error(scan_size)]


def _excess(at_range: xr.Dataset) -> str:
    at_size = at_range.sel(scan_size=at_range.attrs["scan_size"], method="nearest")
    said = []
    for surface in at_size["surface"].values:
        one = at_size.sel(surface=surface)
        said.append(f"{one['label'].item()} {print_bounded_as_paper(one, 'excess', '1')}")
    return (
        f"On mirrored scans of {print_as_paper(at_size['scan_size'].item(), 'nm')} the mean force "
        f"is larger than on surfaces of {print_as_paper(at_size.attrs['surface_size'], 'nm')} with "
        f"the same spectrum, by the factor {'; '.join(said)} at a range of "
        f"{print_as_paper(at_size['rho'].item(), 'nm')}."
    )


def _needed(at_range: xr.Dataset) -> str:
    sizes = zip(at_range["label"].values, at_range["size_needed"].values.tolist(), strict=True)
    said = "; ".join(
        f"{label} {print_as_paper(size, 'nm', digits=DIGITS)}" for label, size in sizes
    )
    allowed = print_percent(at_range.attrs["allowed_excess"] - 1)
    return f"By the rule, a force that is too large by {allowed} takes scans of: {said}."


def _rule(scan_size: xr.Dataset) -> str:
    powers = listed(
        f"({ratio})^{exponent:.{DIGITS}g}"
        for ratio, exponent in zip(
            scan_size["ratio"].values, scan_size["exponent"].values.tolist(), strict=True
        )
    )
    return (
        f"The rule: the logarithm of the factor is {scan_size['strength'].item():.{DIGITS}g} times "
        f"the product of {powers}, the draw size 2√(2Rσ)."
    )


def _error(scan_size: xr.Dataset) -> str:
    said = []
    for tested, name in (
        ("random surfaces", "random surfaces that it was not fitted to"),
        ("surfaces", "the surfaces of the study"),
    ):
        corrected, uncorrected = (
            f"{np.exp(scan_size['error'].sel(tested=tested, kind=kind).item()):.3g}"
            for kind in ("corrected", "uncorrected")
        )
        said.append(f"{uncorrected} to {corrected} on {name}")
    return (
        f"Divided by what the rule says, forces are off by a factor that falls from {listed(said)}."
    )
