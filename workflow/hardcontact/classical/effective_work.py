"""Effective work of adhesion: that of the smooth sphere with the pull-off force of a rough one.

Lengths in nm, forces in N, works of adhesion in J/m².
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.classical import smooth_sphere
from hardcontact.classical.classical_models import Contact
from hardcontact.statistics import with_interval

__all__ = ["PerSurface", "effective_works", "pull_off_coefficients"]


class PerSurface(NamedTuple):
    """A number of each surface, with its interval.

    Attributes
    ----------
    value : array (surface,)
        The number.
    interval : array (surface, 2)
        Low and high end.
    """

    value: np.ndarray
    interval: np.ndarray


def effective_works(
    force: PerSurface, contact: Contact, value: Mapping[Any, float], confidence: float
) -> xr.Dataset:
    """Return the effective work of adhesion with three Tabor parameters.

    These are the printed parameter, that of the published work of adhesion, and the self-consistent
    one, that of the effective work itself. The work is computed with the fit of the transition
    between JKR and DMT; `pull_off_coefficient`, F/πRW, is given by the fit and by the exact pair of
    equations.

    Parameters
    ----------
    force : PerSurface
        Pull-off forces in N.
    contact : Contact
        Sphere and moduli.
    value : mapping of str to float
        Published `tabor_parameter` and `work_of_adhesion` in J/m².
    confidence : float
        Of the interval of the forces.

    Returns
    -------
    xarray.Dataset
        Over transition, tabor and surface.
    """
    tabor, coefficient = ("tabor", "surface"), smooth_sphere.transition_coefficient
    own, ends = (_tabor_parameters(forces, contact, value) for forces in force)
    work, interval = (
        smooth_sphere.effective_work_of_adhesion(
            forces, contact.radius, coefficient(smooth_sphere.maugis_parameter(tabors))
        )
        for forces, tabors in zip(force, (own, ends), strict=True)
    )
    units = {"units": "J m-2"}
    data = xr.Dataset(
        with_interval("effective_work_of_adhesion", tabor, work, interval, units, confidence)
        | {"effective_tabor_parameter": (tabor, own, {"units": "1"})},
        {"tabor": ["printed", "computed", "self_consistent"]},
    )
    return data.assign(
        pull_off_coefficient=pull_off_coefficients(data["effective_tabor_parameter"])
    )


def _tabor_parameters(
    force: np.ndarray, contact: Contact, value: Mapping[Any, float]
) -> np.ndarray:
    """Return Tabor parameters (3, ...) for forces (...), as in `effective_works`."""
    own = smooth_sphere.self_consistent_work_of_adhesion(force, *contact)
    given = smooth_sphere.tabor_parameter(value["work_of_adhesion"], *contact)
    return np.stack(
        [
            np.full(force.shape, value["tabor_parameter"]),
            np.full(force.shape, given),
            smooth_sphere.tabor_parameter(own, *contact),
        ]
    )


def pull_off_coefficients(tabor: xr.DataArray) -> xr.DataArray:
    """Return the pull-off force over πRW by the fit and by the exact pair of equations.

    Parameters
    ----------
    tabor : xarray.DataArray (...)
        Tabor parameters.

    Returns
    -------
    xarray.DataArray (transition, ...)
        Dimensionless.
    """
    maugis = smooth_sphere.maugis_parameter(tabor.values)
    both = {
        "fit": smooth_sphere.transition_coefficient(maugis),
        "maugis_dugdale": smooth_sphere.maugis_dugdale_coefficient(maugis),
    }
    return xr.DataArray(
        np.stack(list(both.values())),
        {"transition": list(both)} | dict(tabor.coords),
        ("transition", *tabor.dims),
        attrs={"units": "1"},
    )
