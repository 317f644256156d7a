"""Range and work of adhesion, inferred from the published mean pull-off forces.

Everything is computed for a work of adhesion of 1 J/m², which merely scales the force.
"""

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from hardcontact.statistics import interval, resampling_counts, with_interval

__all__ = [
    "WORK",
    "at_range",
    "error_region",
    "fit",
    "fit_ratios",
    "infer",
    "mean_relative_error",
    "on_fine_grid",
    "resampled_means",
    "undecided",
]

#: Works of adhesion (J/m²) of the error map.
WORK = np.geomspace(0.005, 1.0, 301)


def resampled_means(pair_means, substrate_counts, sphere_counts):
    """Means over resampled scans.

    pair_means: (surface, scan, sphere_scan, rho), each a mean over the contacts of one pair, NaN
    where a surface has no such scan; substrate_counts: (sample, surface, scan); sphere_counts:
    (sample, sphere_scan). Returns (sample, surface, rho).
    """
    total = np.einsum(
        "nsi,nj,sijr->nsr",
        substrate_counts,
        sphere_counts,
        np.nan_to_num(pair_means),
        optimize=True,
    )
    weight = substrate_counts.sum(axis=2) * sphere_counts.sum(axis=1)[:, None]
    return total / weight[:, :, None]


def on_fine_grid(forces, rhos, fine):
    """Forces (..., rho) on a fine grid of rho, by a cubic spline in log F and log rho."""
    degree = min(3, len(rhos) - 1)
    spline = make_interp_spline(np.log(rhos), np.log(forces), k=degree, axis=-1)
    return np.exp(spline(np.log(fine)))


def at_range(forces, rhos, rho):
    """Forces (..., rho, contacts...) at one rho: linear in log F and log rho.

    forces: DataArray with a dimension rho.
    """
    return np.exp(np.log(forces).assign_coords(rho=np.log(rhos)).interp(rho=np.log(rho)))


def mean_relative_error(mean_forces, published, work):
    """Mean over surfaces of |W f/F - 1|.

    mean_forces: (..., surface, rho) at 1 J/m²; published: (surface,) N; work: (k,) J/m².
    Returns (..., rho, k).
    """
    relative = mean_forces / published[:, None]
    return np.abs(relative[..., None] * work - 1).mean(axis=-3)


def fit(mean_forces, published):
    """Index into rho and work of adhesion (J/m²) of the least mean relative error, and the error.

    mean_forces: (..., surface, rho) at 1 J/m². The error is piecewise linear in W, so that its
    minimum lies at one of the W that match a surface exactly; all are tried.
    """
    relative = mean_forces / published[:, None]
    candidates = 1 / relative  # (..., candidate, rho)
    errors = np.abs(candidates[..., :, None, :] * relative[..., None, :, :] - 1).mean(axis=-2)
    flat = errors.reshape(*errors.shape[:-2], -1)
    best = flat.argmin(axis=-1)
    rho = best % mean_forces.shape[-1]
    work = np.take_along_axis(candidates.reshape(flat.shape), best[..., None], -1)[..., 0]
    return rho, work, np.take_along_axis(flat, best[..., None], -1)[..., 0]


def fit_ratios(mean_forces, published, reference):
    """Index into rho of the least mean relative error of ratios to a reference surface, and errors.

    mean_forces: (..., surface, rho); reference: index of the surface. The work of adhesion
    cancels. Returns (...,) and (..., rho).
    """
    ratios = mean_forces / mean_forces[..., [reference], :]
    expected = (published / published[reference])[:, None]
    others = np.arange(len(published)) != reference
    errors = np.abs(ratios / expected - 1)[..., others, :].mean(axis=-2)
    return errors.argmin(axis=-1), errors


def error_region(errors, rhos, work, threshold):
    """Least and greatest rho and W where the error map (rho, work) is below `threshold`.

    Returns (rho_low, rho_high, work_low, work_high); NaN where there is no such place.
    """
    inside = errors < threshold
    if not inside.any():
        return (np.nan,) * 4
    rows, columns = np.nonzero(inside)
    return rhos[rows.min()], rhos[rows.max()], work[columns.min()], work[columns.max()]


def undecided(best_error, threshold, low, high, rhos):
    """What the data cannot decide about the range of adhesion, in one sentence.

    low, high: bootstrap interval (nm); rhos: the values computed (nm).
    """
    said = []
    if best_error >= threshold:
        said.append(
            f"no range and work of adhesion bring the mean relative error below "
            f"{threshold:g} (least {best_error:.2f})"
        )
    if high >= 0.99 * rhos[-1]:
        said.append(
            f"the interval reaches the largest range computed, {rhos[-1]:g} nm: "
            "there is no upper bound"
        )
    if low <= 1.02 * rhos[0]:
        said.append(
            f"the interval reaches the smallest range computed, {rhos[0]:g} nm: "
            "there is no lower bound"
        )
    said.append(
        f"ranges of adhesion between {low:.1f} and {high:.1f} nm cannot be told apart "
        "by these scans"
    )
    return "; ".join(said)


def infer(forces, published, reference, rng, samples, confidence, threshold):
    """Range and work of adhesion of one contact model, with what leads to them.

    forces: DataArray (surface, scan, sphere_scan, rho, contact_y, contact_x), N at 1 J/m², NaN
    where a scan is missing; published: (surface,) mean forces in N, NaN where there is none: such
    surfaces do not enter the fit; reference: index of the surface that ratios are taken to.
    Intervals resample substrate and sphere scans. Returns a Dataset over surface, rho, rho_fine,
    work and sample.
    """
    rhos = forces.rho.values
    fine = np.geomspace(rhos[0], rhos[-1], 401)
    means, sampled = _means(forces, rng, samples)
    known = np.isfinite(published)
    target, base = published[known], int(known[:reference].sum())
    curve = on_fine_grid(means[known], rhos, fine)
    sampled_curves = on_fine_grid(sampled[:, known], rhos, fine)
    best, work, error = fit(curve, target)
    sampled_best, sampled_work, _ = fit(sampled_curves, target)
    best_ratio, ratio_error = fit_ratios(curve, target, base)
    sampled_ratio, _ = fit_ratios(sampled_curves, target, base)
    low, high = interval(fine[sampled_best], confidence)

    per_surface, newton, one = ("surface", "rho"), {"units": "N"}, {"units": "1"}
    nm, energy = {"units": "nm"}, {"units": "J m-2"}
    ratio, sampled_ratios = means / means[reference], sampled / sampled[:, [reference]]
    spread = forces.std(["scan", "sphere_scan", "contact_y", "contact_x"]).values
    variables = {
        "contact_spread": (per_surface, spread, newton),
        "ratio_contact_spread": (per_surface, spread / means[reference], one),
        "ratio_error": ("rho_fine", ratio_error, one),
        "best_error": ((), error, one),
        "bootstrap_range": ("sample", fine[sampled_best], nm),
        "bootstrap_work": ("sample", sampled_work, energy),
        "undecided": ((), undecided(error, threshold, low, high, rhos)),
    } | _error_map(curve, target, fine, threshold)
    for name, dimensions, value, values, attributes in (
        ("mean_force", per_surface, means, sampled, newton),
        ("ratio", per_surface, ratio, sampled_ratios, one),
        ("range_of_adhesion", (), fine[best], fine[sampled_best], nm),
        ("work_of_adhesion", (), work, sampled_work, energy),
        ("range_from_ratios", (), fine[best_ratio], fine[sampled_ratio], nm),
    ):
        variables |= with_interval(name, dimensions, value, values, confidence, attributes)
    coordinates = {"rho_fine": ("rho_fine", fine, nm), "work": ("work", WORK, energy)}
    return xr.Dataset(variables, {"surface": forces.surface, "rho": forces.rho} | coordinates)


def _means(forces, rng, samples):
    """Mean forces (surface, rho) over all scans, and (sample, surface, rho) over resampled ones."""
    pairs = forces.mean(["contact_y", "contact_x"]).values
    scans = np.isfinite(pairs).any(axis=(2, 3))
    spheres = np.isfinite(pairs).any(axis=(0, 1, 3))
    drawn = np.stack([resampling_counts(rng, known, samples) for known in scans], axis=1)
    drawn_spheres = resampling_counts(rng, spheres, samples)
    once = scans[None].astype(float), spheres[None].astype(float)
    return resampled_means(pairs, *once)[0], resampled_means(pairs, drawn, drawn_spheres)


def _error_map(curve, published, fine, threshold):
    """The error over range and work of adhesion, and the region where it is below the threshold."""
    errors = mean_relative_error(curve, published, WORK)
    names = ("range_low", "range_high", "work_low", "work_high")
    ends = zip(names, error_region(errors, fine, WORK, threshold), strict=True)
    return {
        "mean_relative_error": (("rho_fine", "work"), errors, {"units": "1"}),
        **{
            f"region_{name}": ((), end, {"units": "nm" if "range" in name else "J m-2"})
            for name, end in ends
        },
    }
