"""Which second sphere tells two pairs of range and work of adhesion apart, on which surface.

Both pairs fit the mean forces that were measured with one sphere, so that only the change of the
force tells: x = ln[F(R, P)/F(R0, P0)] on the same surface, in which the work of adhesion cancels.
Pair g predicts x_g; with the variance v_g of x about it, the pairs lie

    z = |x_1 - x_2| / sqrt((v_1 + v_2)/2)

standard errors apart. v has four parts. The range, which the fits of a group scatter about. The
spectrum: rms height and Hurst exponent move both forces at once, which cancels in part. The closed
form: the mean square by which its logarithmic errors differ between designed surfaces like one
contact and those like the other (`prediction.change_error`); an error that both contacts share
cancels, one that both pairs share does not, because one measured change is held against either. And
the tests: their forces scatter over places as the law says (`pull_off_statistics`); published ones
scatter by more, and this excess, a log-normal factor, may lie between tests or between spheres.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from hardcontact.insight.closed_form import Contact, closed_form, contact_share
from hardcontact.insight.prediction import change_error, coordinates, is_tried, rough_part
from hardcontact.insight.pull_off_statistics import ForceStatistics, force_statistics
from hardcontact.records.dataset import stack
from hardcontact.surfaces.joined_spectrum import HURST_SCATTER
from hardcontact.surfaces.spectrum import Floats, Spectrum, roll_off

#: The pairs that are to be told apart.
PAIRS = ("long_range", "short_range")
#: Where the scatter beyond that of the law lies.
SCATTER = ("tests", "spheres")
#: Standard errors between two pairs from which on 95 of 100 measured changes lie nearer to their
#: own, if both have the same error: half of them is the quantile of the normal distribution.
RIGHT = 2 * 1.645
#: Radii (nm) of the next sphere.
RADII = (1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 5e5, 1e6)


@dataclass(frozen=True)
class Spheres:
    """The sphere that was measured with, those that may be next, and how they are tested."""

    radius: float  #: In nm, of the sphere that was measured with.
    preload: float  #: In N, likewise.
    hardness: float  #: In Pa.
    radii: tuple[float, ...]  #: Of the next sphere.
    preloads: tuple[float, ...]
    tests: int  #: Contacts that a mean force is over.
    spheres: int  #: Different ones that they are made with.
    floor: float  #: The least force in N that is resolved.

    def contact(self, radius: float, preload: float, rho: float) -> Contact:
        """Return a contact at 1 J/m²."""
        return Contact(radius, rho, 1.0, preload / self.hardness * 1e18)


class Known(NamedTuple):
    """What is known of a surface that was measured on."""

    spectrum: Spectrum
    height_error: float  #: Relative standard deviation of its rms height.
    mean_force: float  #: Measured, in N.
    scatter: float  #: Standard deviation of the logarithms of measured forces.


class _Mean(NamedTuple):
    """A mean force of the closed form."""

    #: ln F at 1 J/m²: of the spectrum, of more height, of another exponent, at a longer range.
    logarithms: Floats
    place: Mapping[str, Any]  #: Among the designed surfaces.
    tried: bool  #: Whether errors of the closed form are known there.


def mean_variance(law: ForceStatistics, measured: float, spheres: Spheres) -> Floats:
    """Return the variance (2,) of the logarithm of a mean force, by SCATTER.

    What the law gives lies between tests. The scatter that was measured is of ln F; its excess is
    a log-normal factor, as ratios of mean and median are read, and so is a mean of such factors.
    """
    excess = max(measured**2 - law.spread**2, 0.0)
    shared = np.array([spheres.tests, spheres.spheres])
    return np.asarray(law.variation**2 / spheres.tests + np.log1p(np.expm1(excess) / shared))


def varied(known: Known) -> list[Spectrum]:
    """Return the spectrum, and it changed by a standard deviation of rms height and of H."""
    waves = rough_part(known.spectrum)
    higher = waves.density * (1 + known.height_error) ** 2
    finer = np.maximum(waves.wavevector * roll_off(waves) / (2 * np.pi), 1.0)
    flatter = waves.density * finer ** (2 * HURST_SCATTER)
    return [waves, *(Spectrum(waves.wavevector, density) for density in (higher, flatter))]


def next_spheres(
    surfaces: Mapping[str, Known], ranges: Mapping[str, tuple[float, float]], spheres: Spheres
) -> xr.Dataset:
    """Return how far every next sphere separates the pairs on every surface.

    The ranges of adhesion (nm), with the standard deviations of their logarithms, are by PAIRS.
    Over (surface, pair, preload, radius) stand ``predicted_change`` of ln F, ``predicted_force``
    (N), the measured one times this change, and the roots of the parts of its variance,
    ``range_error``, ``spectrum_error``, ``model_error`` and ``test_error`` (also over scatter).
    Over (surface, preload, radius) stand ``separation`` (also over scatter) in standard errors;
    ``tried``, 1 where errors of the closed form are known at both pairs; and ``resolved``, 1 where
    both forces exceed the floor.
    """
    found = stack(
        {
            (name, pair, *sphere): change
            for (name, known), pair in product(surfaces.items(), PAIRS)
            for sphere, change in _changes(known, *ranges[pair], spheres)
        },
        ["surface", "pair", "preload", "radius"],
    )
    units = {"predicted_force": "N", "preload": "N", "radius": "nm"}
    for name in (*found.data_vars, "preload", "radius"):
        found[name].attrs["units"] = units.get(str(name), "1")
    variance = xr.zeros_like(found["test_error"])
    for name in ("range_error", "spectrum_error", "model_error", "test_error"):
        variance = variance + found[name] ** 2
    change = found["predicted_change"].sel(pair=list(PAIRS))
    apart = abs(change.diff("pair").squeeze("pair", drop=True))
    resolved = found["predicted_force"].min("pair") >= spheres.floor
    return found.assign(
        separation=(apart / variance.mean("pair") ** 0.5).assign_attrs(units="1"),
        tried=found["tried"].min("pair"),
        resolved=resolved.astype(int),
    )


def _changes(
    known: Known, rho: float, deviation: float, spheres: Spheres
) -> Iterator[tuple[tuple[float, float], xr.Dataset]]:
    """Yield preload and radius of the next spheres, and the change of the force with its errors."""
    spectra = varied(known)
    of_paper = spheres.contact(spheres.radius, spheres.preload, rho)
    before = _mean(spectra, of_paper, deviation)
    measured = mean_variance(force_statistics(spectra[0], of_paper), known.scatter, spheres)
    for preload, radius in product(spheres.preloads, spheres.radii):
        contact = spheres.contact(radius, preload, rho)
        after = _mean(spectra, contact, deviation)
        change, *changed = after.logarithms - before.logarithms
        *by_spectrum, by_range = np.abs(np.subtract(changed, change))
        tests = mean_variance(force_statistics(spectra[0], contact), known.scatter, spheres)
        values = {
            "predicted_change": change,
            "predicted_force": known.mean_force * np.exp(change),
            "range_error": by_range,
            "spectrum_error": np.hypot(*by_spectrum),
            "model_error": change_error(after.place, before.place),
            "test_error": ("scatter", np.sqrt(tests + measured)),
            "tried": int(after.tried and before.tried),
        }
        yield (preload, radius), xr.Dataset(values, {"scatter": list(SCATTER)})


def _mean(spectra: list[Spectrum], contact: Contact, deviation: float = 0.0) -> _Mean:
    """Return the mean force of a contact on a spectrum and its variants, and at a longer range."""
    found = [closed_form(one, contact) for one in spectra]
    longer = replace(contact, rho=contact.rho * np.exp(deviation))
    found.append(closed_form(spectra[0], longer))
    return _Mean(
        np.log([one.force for one in found]),
        coordinates(spectra[0], contact, found[0]),
        is_tried(spectra[0], contact, found[0]) and contact_share(contact) < 1,
    )


def checked_changes(
    forces: Mapping[str, xr.DataArray], spectra: Mapping[str, Spectrum], spheres: Spheres
) -> dict[str, float | list[float]]:
    """Return how well the closed form knows computed changes of the force.

    Mean forces by surface, over (radius, area, rho) in nm, nm² and nm, are of computed masters.
    Their changes from the sphere and area that were measured with, at every range, are held to the
    predicted ones. Returned are their number, the ends of their radii (nm), the share within 1.96
    of `change_error`, and the root mean squares of the errors and of what was stated. Where no
    error is known none is counted.
    """
    misses, stated, radii = [], [], []
    for name, force in forces.items():
        waves, computed = rough_part(spectra[name]), force.copy(data=np.log(force))
        for rho in force["rho"].values:
            measured = spheres.contact(spheres.radius, spheres.preload, rho)
            at = {"radius": measured.radius, "area": measured.area, "rho": rho}
            before, start = _mean([waves], measured), computed.sel(at, method="nearest").item()
            for radius, area in product(force["radius"].values, force["area"].values):
                after = _mean([waves], replace(measured, radius=radius, area=area))
                change = computed.sel(radius=radius, area=area, rho=rho).item() - start
                if change and after.tried and before.tried:
                    misses.append(change - (after.logarithms[0] - before.logarithms[0]))
                    stated.append(change_error(after.place, before.place))
                    radii.append(float(radius))
    errors, known = np.abs(misses), np.array(stated)
    return {
        "checked_changes": len(misses),
        "checked_radii": [min(radii, default=np.nan), max(radii, default=np.nan)],
        "checked_share": float(np.mean(errors <= 1.96 * known)),
        "checked_error": float(np.sqrt(np.mean(errors**2))),
        "checked_stated": float(np.sqrt(np.mean(known**2))),
    }
