"""The rule for the size of scans: fitted on random surfaces, tested on those of a study.

Random self-affine surfaces differ in rms height, roll-off, Hurst exponent and sphere. The rule that
fits them is tested on spectra that it was not fitted to.
"""

from collections.abc import Mapping
from typing import TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.insight.scan_size_rule import Case, fitted_rule, rule_error
from hardcontact.insight.scan_windows import WindowContacts, window_forces
from hardcontact.insight.window_edges import ratio_of_means
from hardcontact.random import generator
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, all_scales_moments, roll_off
from hardcontact.surfaces.synthesis import random_surface

__all__ = ["RATIOS", "Trials", "random_spectra", "scan_size_trials", "window_excess"]

#: Rms heights and roll-offs (nm) and Hurst exponents between which random spectra are drawn.
RMS_HEIGHTS, ROLL_OFFS, HURST = (2.0, 120.0), (300.0, 4000.0), (0.5, 1.2)
#: The ratios that the rule is a power law of.
RATIOS = ["draw size / scan size", "roll-off / scan size", "rms height / range"]


class Trials(TypedDict):
    """Surfaces that the rule is fitted to and tested on.

    Attributes
    ----------
    size : float
        Edge of a surface in nm.
    pixels, realizations : int
        Along an edge of a surface, and surfaces of each spectrum.
    count : int
        Random spectra that the rule is fitted to.
    radii : list of float
        Of the spheres on these, in turn, in nm.
    contacts : WindowContacts
        Windows and contacts; the radius is that on the tested surfaces.
    excess : float
        Factor of the force that a scan may add, for the size that is needed.
    seed : int
        Of spectra and surfaces.
    confidence : float
        Of intervals.
    """

    size: float
    pixels: int
    realizations: int
    count: int
    radii: list[float]
    contacts: WindowContacts
    excess: float
    seed: int
    confidence: float


def random_spectra(rng: np.random.Generator, count: int) -> list[Spectrum]:
    """Return self-affine spectra: rms height and roll-off log-uniform, Hurst exponent uniform."""
    spectra = []
    for _ in range(count):
        height, wavelength = (
            np.exp(rng.uniform(*np.log(ends))) for ends in (RMS_HEIGHTS, ROLL_OFFS)
        )
        shape = self_affine(WAVEVECTORS, 1.0, wavelength, rng.uniform(*HURST))
        own = all_scales_moments(Spectrum(WAVEVECTORS, shape))[0]
        spectra.append(Spectrum(WAVEVECTORS, shape * (height / own) ** 2))
    return spectra


def window_excess(name: str, spectrum: Spectrum, radius: float, trials: Trials) -> xr.Dataset:
    """Return how much larger the force is on windows than on surfaces of a spectrum.

    Parameters
    ----------
    name : str
        Of the spectrum, for its random numbers.
    spectrum : Spectrum
        Of the surfaces.
    radius : float
        Of the sphere in nm.
    trials : Trials
        Surfaces and windows.

    Returns
    -------
    xarray.Dataset
        ``excess`` (scan_size, rho), the mean force over realizations on windows over that on the
        surfaces, with its interval from those of single realizations; ``rms_height``,
        ``roll_off`` and ``radius`` in nm.
    """
    contacts: WindowContacts = {**trials["contacts"], "radius": radius}
    pixel_size = trials["size"] / trials["pixels"]
    forces = []
    for realization in range(trials["realizations"]):
        rng = generator(trials["seed"], name, realization, "scan size")
        surface = random_surface(rng, trials["pixels"], pixel_size, spectrum)
        forces.append(window_forces(surface, contacts).variables["pull_off_force"][1])
    force = xr.DataArray(
        forces,
        {"scan_size": [*contacts["sizes"], trials["size"]], "rho": contacts["ranges"]},
        ["realization", "scan_size", "rho"],
    )
    windows, whole = force.isel(scan_size=slice(-1)), force.isel(scan_size=-1, drop=True)
    excess, interval = ratio_of_means(windows, whole, trials["confidence"])
    nm = {"units": "nm"}
    return xr.Dataset(
        {
            "excess": excess,
            "excess_interval": interval,
            "rms_height": ((), all_scales_moments(spectrum)[0], nm),
            "roll_off": ((), roll_off(spectrum), nm),
            "radius": ((), radius, nm),
        }
    )


def scan_size_trials(spectra: Mapping[str, Spectrum], trials: Trials) -> xr.Dataset:
    """Return the rule, the excess of the force that it predicts, and its error.

    Parameters
    ----------
    spectra : mapping of str to Spectrum
        By surface, to test the rule on.
    trials : Trials
        What is computed.

    Returns
    -------
    xarray.Dataset
        Over (surface, scan_size, rho) ``excess`` with its interval and ``predicted_excess``, over
        (trial, scan_size, rho) the same of random surfaces as ``known_excess`` and
        ``predicted_known_excess``, each from a rule that was fitted without its spectrum;
        ``strength`` and ``exponent`` (ratio) of the rule; ``error`` (tested, kind), root mean
        square of ln(force), of "random surfaces" and "surfaces", "corrected" by the rule and
        "uncorrected"; ``size_needed`` (surface, rho) in nm for the excess of the trials.
    """
    drawn = random_spectra(generator(trials["seed"], "scan size spectra"), trials["count"])
    radii = [trials["radii"][one % len(trials["radii"])] for one in range(len(drawn))]
    known = xr.concat(
        [
            window_excess(f"random {one}", spectrum, radius, trials)
            for one, (spectrum, radius) in enumerate(zip(drawn, radii, strict=True))
        ],
        "trial",
    )
    radius = trials["contacts"]["radius"]
    tested = xr.concat(
        [window_excess(name, one, radius, trials) for name, one in spectra.items()], "surface"
    ).assign_coords(surface=list(spectra))
    rule = fitted_rule(_case(known), _flat(known))
    left_out = [
        fitted_rule(_case(others), _flat(others)).excess(_case(known.isel(trial=[one])))
        for one in range(trials["count"])
        for others in [known.drop_isel(trial=one)]
    ]
    known_excess = known["excess"]
    misses = np.log(_flat(known)) - np.log(np.concatenate(left_out))
    of_known = np.sqrt([(misses**2).mean(), (np.log(_flat(known)) ** 2).mean()])
    of_tested = rule_error(rule, _case(tested), _flat(tested))
    needed = rule.size_for(_case(tested.isel(scan_size=[0])), trials["excess"])
    dims = ("surface", "scan_size", "rho")
    shape = tuple(tested.sizes[name] for name in dims)
    one = {"units": "1"}
    return tested.assign(
        predicted_excess=(dims, rule.excess(_case(tested)).reshape(shape), one),
        known_excess=known_excess,
        predicted_known_excess=(
            ("trial", *dims[1:]), np.concatenate(left_out).reshape(known_excess.shape), one,
        ),
        strength=((), rule.strength, one),
        exponent=("ratio", rule.exponents, one),
        error=(("tested", "kind"), [of_known, of_tested], one),
        size_needed=(("surface", "rho"), needed.reshape(shape[0], shape[2]), {"units": "nm"}),
    ).assign_coords(
        ratio=RATIOS, tested=["random surfaces", "surfaces"], kind=["corrected", "uncorrected"]
    ).assign_attrs(
        sphere_radius=radius, surface_size=trials["size"], allowed_excess=trials["excess"],
        confidence=trials["confidence"],
    )  # fmt: skip


def _case(excess: xr.Dataset) -> Case:
    """Return the scans of a dataset of `window_excess`, stacked, flat."""
    variables = (
        excess["scan_size"], excess["rms_height"], excess["roll_off"], excess["radius"],
        excess["rho"],
    )  # fmt: skip
    like = excess["excess"]
    return Case(
        *(one.broadcast_like(like).transpose(*like.dims).values.ravel() for one in variables)
    )


def _flat(excess: xr.Dataset) -> NDArray[np.float64]:
    """Return the factors of the force in the order of `_case`."""
    return np.asarray(excess["excess"].values.ravel())
