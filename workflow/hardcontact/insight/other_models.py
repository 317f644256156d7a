"""Models of others for the pull-off of a sphere from a Gaussian surface, beside computed forces.

All are for stiff bodies: nothing deforms but what touches, which carries the load at the hardness.
A plane at the separation s from the mean plane of heights h of the rms sigma attracts with the mean
pressure p(s); a sphere of the radius R, its apex at m, with 2 pi R ∫_m^∞ p ds (Derjaguin) and, as
all forces of the study, with W/rho on the area A in contact. Written over 2 pi R W:

- Persson and Scaraggi, J. Chem. Phys. 141 (2014) 124701 (arXiv 1405.3123), their limit of hard
  solids: p is the mean of the law of attraction over the distribution of separations, here that of
  undeformed heights. With Eq. 1 as the law it is exp(sigma²/2rho² - m/rho) Phi(m/sigma - sigma/rho)
  + Q(m/sigma), which `closed_form` derives, Q the upper tail of the normal distribution.
- Ciavarella, Meccanica 53 (2018) 241, the bearing-area model: a constant stress within a range acts
  on the bearing area at the separation less this range, where it does not touch. With strength and
  work of Eq. 1, the stress W/rho over rho, p = (W/rho) [Q((s - rho)/sigma) - Q(s/sigma)], hence
  (1/rho) ∫ Q(z/sigma) dz from m - rho to m.
- Rabinovich et al., as in `classical_models`: with peaks a wavelength apart, and the equilibrium
  spacing 2 rho, at which van der Waals pressure between planes of the same work is that of Eq. 1.

Ours are the law of attraction, the integral over the sphere, and where it comes to rest: at the
bearing area A of the mean surface. The closed form has it from the summits that touch; with this
approach ("_at_summits") the first two show what is due to themselves alone. Equations are
unverified against the primary sources, of which only abstracts were at hand: of the first its
limit of hard solids with weak or long-ranged interaction; of the second, in the abstracts of arXiv
1801.00717 and Tribol. Int. 133 (2019) 263, that it is of the same kind, for Gaussian heights, and
does without the convolution of the first, and that neither slope nor curvature enters.
"""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.inference.classical_models import rabinovich
from hardcontact.insight.closed_form import MANY_POINTS, SINGLE_PEAKS, SMOOTH, gaussian_share
from hardcontact.numbers.statistics import with_interval

Floats = NDArray[np.float64]

MODELS = [
    "closed_form", "persson_scaraggi", "persson_scaraggi_at_summits",
    "bearing_area", "bearing_area_at_summits", "rabinovich",
]  # fmt: skip
#: Share of the designed surfaces between the ends of what a model has for them.
MOST = 0.9
#: Factor between forces up to which one counts as that of the other.
RIGHT = 2.0
#: Steps of Newton's iteration: more than the highest level takes.
NEWTON = 40
ONE = {"units": "1"}


class Cases(NamedTuple):
    """Contacts of a sphere with surfaces: arrays that broadcast; lengths in nm, the area in nm²."""

    radius: ArrayLike
    rho: ArrayLike  #: Range of adhesion.
    area: ArrayLike  #: In contact: load over hardness, more than zero.
    rms_height: ArrayLike
    rms_gradient: ArrayLike
    approach: ArrayLike  #: Height of closest approach m of the closed form.


def bearing_approach(rms_height: ArrayLike, radius: ArrayLike, area: ArrayLike) -> Floats:
    """Return the height m (nm) at which the mean surface above a sphere has a given area (nm²).

    It solves 2 pi R sigma ∫_t^∞ Q(u) du = A, t = m/sigma. The integral is convex and falls, so that
    Newton's iteration goes up to the only root.
    """
    height = np.asarray(rms_height)
    share = np.asarray(area) / (2 * np.pi * np.asarray(radius) * height)
    level = -1 - share
    for _ in range(NEWTON):
        level = level + (_tail(level) - share) / stats.norm.sf(level)
    return np.asarray(height * level)


def persson_scaraggi(rms_height: ArrayLike, approach: ArrayLike, rho: ArrayLike) -> Floats:
    """Return the force of a plane's mean attraction, over 2 pi R W; lengths in nm, broadcast."""
    level = np.divide(approach, rms_height)
    return np.asarray(gaussian_share(rms_height, approach, rho) + stats.norm.sf(level))


def bearing_area_model(rms_height: ArrayLike, approach: ArrayLike, rho: ArrayLike) -> Floats:
    """Return (1/rho) ∫ Q(z/sigma) dz from m - rho to m: the force over 2 pi R W.

    Lengths are in nm; they broadcast.
    """
    levels = (np.divide(np.subtract(approach, below), rms_height) for below in (rho, 0))
    within, touching = map(_tail, levels)
    return np.divide(rms_height, rho) * (within - touching)


def _tail(level: Floats) -> Floats:
    """Return ∫_t^∞ Q(u) du = phi(t) - t Q(t)."""
    return np.asarray(stats.norm.pdf(level) - level * stats.norm.sf(level))


def forces_of_others(cases: Cases) -> list[Floats]:
    """Return the force over 2 pi R W of each of MODELS but the first, the closed form."""
    radius, rho, area, height, gradient, approach = map(np.asarray, cases)
    share = area / (2 * np.pi * radius * rho)
    at_bearing_area = bearing_approach(height, radius, area)
    of_caps = rabinovich(1.0, radius, height, 2 * np.pi * height / gradient, 2 * rho)
    return [
        persson_scaraggi(height, at_bearing_area, rho) + share,
        persson_scaraggi(height, approach, rho) + share,
        bearing_area_model(height, at_bearing_area, rho) + share,
        bearing_area_model(height, approach, rho) + share,
        np.asarray(of_caps / dmt_pull_off(1.0, radius)),
    ]


def models_beside_computed(designed: pd.DataFrame, closed_form: xr.Dataset) -> xr.Dataset:
    """Return what the closed form and the models of others have of forces that were computed.

    `designed` is the table of designed surfaces (`prediction.VALIDATION`), the dataset that of
    `closed_form_errors`, of which the largest maps are taken.

    ``factor`` (model, design) and ``surface_factor`` (model, surface, rho) are predicted over
    computed forces, beside ``modulus`` (design) and ``surface_modulus`` (surface, rho), k = rho
    m/sigma²; NaN of a surface that the sphere follows. By design also ``held_back`` and
    ``force_error``, the standard error of ln F. Of what was held back, by (model, regime):
    ``median_factor``, whose interval holds MOST of them, and ``rms_factor``, exp of the rms
    logarithm; by model ``last_wrong``, the greatest modulus at which one is off by more than RIGHT.
    """
    of_design = ("radius", "rho", "area", "waves_height", "waves_gradient", "approach")
    smooth = dmt_pull_off(1.0, designed["radius"].to_numpy())
    factor = _factors(
        Cases(*(designed[name].to_numpy() for name in of_design)),
        designed["predicted_force"].to_numpy() / smooth,
        designed["force"].to_numpy() / smooth,
    )
    return xr.Dataset(
        {
            "factor": (("model", "design"), factor, ONE),
            "modulus": ("design", designed["modulus"], ONE),
            "held_back": ("design", designed["held_back"], ONE),
            "force_error": ("design", designed["force_error"], ONE),
        }
        | _on_surfaces(closed_form)
        | _of_held_back(factor, designed),
        {"model": MODELS, "design": designed["surface"]},
    ).assign(label=closed_form["label"], basis=closed_form["basis"])


def _on_surfaces(closed_form: xr.Dataset) -> dict[str, Any]:
    """Return factors and moduli on the largest maps of the study's surfaces."""
    largest = closed_form.isel(map_size=-1).sel(source="spectrum").transpose("surface", "rho", ...)
    rough = largest["waves_height"] > 0
    radius, work = (closed_form.attrs[name] for name in ("sphere_radius", "work_of_adhesion"))
    of_grid = ("contact_area", "waves_height", "waves_gradient", "predicted_approach")
    grid = (largest[name].where(rough).values[:, None] for name in of_grid)
    smooth = dmt_pull_off(work, radius)
    factor = _factors(
        Cases(radius, largest["rho"].values, *grid),
        largest["predicted_force"].values / smooth,
        largest["computed_force"].values / smooth,
    )
    modulus = 1 / largest["freezing"].where(rough).reset_coords(drop=True)
    over = ("model", "surface", "rho")
    return {"surface_factor": (over, factor, ONE), "surface_modulus": modulus.assign_attrs(ONE)}


def _of_held_back(factor: Floats, designed: pd.DataFrame) -> dict[str, Any]:
    """Return how far models are off on the surfaces held back, of factors (model, design)."""
    there = designed["held_back"].to_numpy() == 1
    held_back, modulus = factor[:, there], designed["modulus"].to_numpy()[there]
    of_regime = designed["regime"].to_numpy()[there]
    regimes = [one for one in (SMOOTH, MANY_POINTS, SINGLE_PEAKS) if one in of_regime]
    parts = [held_back[:, of_regime == one] for one in regimes]
    tail, over = (1 - MOST) / 2, ("model", "regime")
    quantiles = [np.quantile(part, [tail, 0.5, 1 - tail], axis=1).T for part in parts]
    low, median, high = np.moveaxis(np.stack(quantiles, axis=1), -1, 0)
    rms = [np.exp(np.sqrt((np.log(part) ** 2).mean(axis=1))) for part in parts]
    wrong = np.abs(np.log(held_back)) > np.log(RIGHT)
    ends = np.stack([low, high], axis=-1)
    return with_interval("median_factor", over, median, ends, ONE, MOST) | {
        "rms_factor": (over, np.stack(rms, axis=1), ONE),
        "last_wrong": ("model", (modulus * wrong).max(axis=1), ONE),
        "regime": regimes,
    }


def _factors(cases: Cases, closed_form: Floats, computed: Floats) -> Floats:
    """Return forces (model, ...) of the closed form and of the others over those computed."""
    forces = [closed_form, *forces_of_others(cases)]
    return np.stack(np.broadcast_arrays(*forces)) / computed
