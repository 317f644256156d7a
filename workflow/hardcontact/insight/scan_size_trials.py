"""How large a scan must be: a rule for the excess of the force on small mirrored scans.

A contact finds its peaks within some 2 sqrt(2 R sigma) of each other. A smaller scan,
mirrored, has fewer peaks, so that the sphere misses the highest of them. How much that counts may
depend on this draw size and on the roll-off, both over the size of the scan, and on the heights
over the range of adhesion. The rule is a power law of these three ratios, with exponents of either
sign as the fit finds them. It is fitted to random self-affine surfaces, which differ in rms height,
roll-off, Hurst exponent and sphere, and tested on spectra that it was not fitted to.

Mirrored windows also have a long edge of the band, beside that of whole random surfaces. A window
has no waves longer than its period, so that nothing is known of their removal: where a window's
force changes as soon as its longest waves go, the edge is open, and at least so long.
"""

from collections.abc import Mapping
from itertools import cycle
from typing import NamedTuple, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.insight.scan_windows import WindowContacts, window_forces
from hardcontact.numbers.random import generator
from hardcontact.numbers.statistics import student_interval, student_log_interval
from hardcontact.own_surfaces.open_edges import edges_of_curves
from hardcontact.records.dataset import stack
from hardcontact.scales.critical_band import logarithmic_limits
from hardcontact.surfaces.spectral_models import self_affine
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Floats,
    Spectrum,
    all_scales_moments,
    roll_off,
)
from hardcontact.surfaces.synthesis import random_surface

#: Rms heights and roll-offs (nm) and Hurst exponents between which random spectra are drawn.
RMS_HEIGHTS, ROLL_OFFS, HURST = (2.0, 120.0), (300.0, 4000.0), (0.5, 1.2)
#: The ratios that the rule is a power law of.
RATIOS = ["draw size / scan size", "roll-off / scan size", "rms height / range"]


class Case(NamedTuple):
    """Scans of surfaces under a sphere; all lengths in nm, of shapes that go with each other."""

    size: ArrayLike  #: Side of the scan.
    rms_height: ArrayLike  #: Of the surface.
    roll_off: ArrayLike  #: Of the surface.
    radius: ArrayLike  #: Of the sphere.
    rho: ArrayLike  #: Range of adhesion.

    def ratios(self) -> Floats:
        """Return logarithms (3, n) of draw size and roll-off over scan size, of sigma over rho."""
        size, height, roll_off, radius, rho = map(np.asarray, self)
        draw = 2 * np.sqrt(2 * radius * height)
        ratios = np.broadcast_arrays(draw / size, roll_off / size, height / rho)
        return np.asarray(np.log(np.stack(ratios)))


class ScanSizeRule(NamedTuple):
    """A power law: ln(force on the scan / on a large one) = strength * prod(ratios**exponents)."""

    strength: float  #: Where all ratios are 1.
    exponents: Floats  #: (3,) of the ratios of `Case`.

    def excess(self, case: Case) -> Floats:
        """Return the factor by which the force on a scan is too large."""
        logarithm = self.strength * np.exp(np.tensordot(self.exponents, case.ratios(), 1))
        return np.asarray(np.exp(logarithm))

    def size_for(self, case: Case, excess: float) -> Floats:
        """Return the side (nm) of a scan whose force is too large by a given factor.

        The size of the case does not matter.
        """
        one = case._replace(size=1.0)
        logarithm = np.log(self.strength) + np.tensordot(self.exponents, one.ratios(), 1)
        steepness = self.exponents[0] + self.exponents[1]
        return np.asarray(np.exp((logarithm - np.log(np.log(excess))) / steepness))


def fitted_rule(case: Case, excess: ArrayLike) -> ScanSizeRule:
    """Return the rule that fits measured factors (n,) best, by least squares of their logarithms.

    Logarithms of factors that scatter about one may be negative; they are fitted as they are.
    ValueError of fewer than four scans.
    """
    from scipy.optimize import least_squares

    ratios, measured = case.ratios(), np.log(np.asarray(excess, float))
    if measured.size < 4:
        raise ValueError(f"expected four scans or more to fit a rule to, found {measured.size}")

    def misfit(parameters: Floats) -> Floats:
        return np.asarray(np.exp(parameters[0] + parameters[1:] @ ratios) - measured)

    found = least_squares(misfit, np.array([np.log(0.3), 1.0, 0.0, 0.0])).x
    return ScanSizeRule(float(np.exp(found[0])), found[1:])


def correction_errors(predicted: ArrayLike, excess: ArrayLike) -> list[float]:
    """Return the root mean squares of ln(force) that are left with and without a correction.

    It divides measured factors (n,) by predicted ones. It is worth making where the first error is
    well below the second, on scans that the rule was not fitted to.
    """
    measured = np.log(np.asarray(excess, float))
    left = measured - np.log(predicted)
    return [float(np.sqrt((one**2).mean())) for one in (left, measured)]


def ratio_of_means(
    forces: xr.DataArray, reference: xr.DataArray, confidence: float
) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the mean force over realizations over that of a reference, and its interval.

    The latter is that of the ratios of single realizations by Student's t of their logarithms,
    about the ratio of the means.
    """
    ratio = forces.mean("realization") / reference.mean("realization")
    single = forces / reference
    about = student_log_interval(single, confidence, "realization")
    return ratio.assign_attrs(units="1"), ratio * about / single.mean("realization")


def window_edges(
    forces: Mapping[str, xr.Dataset], tolerance: float, confidence: float
) -> xr.Dataset:
    """Return the long edges of the band from windows and whole surfaces, and the forces on them.

    The forces are of `filtered_window_forces`, by surface; the tolerance is the relative change of
    the force that counts.

    With intervals: ``long_ratio`` (surface, edge_size, cutoff_wavelength), the mean over
    realizations of the force without longer waves over that with all, and ``force_over_largest``
    (surface, edge_size), the force over that on the larger whole surface. What `described_edge`
    says of each edge size has names that begin with ``long_``. ``period`` and ``mirrored`` are
    those of the forces.
    """
    given = next(iter(forces.values()))[["period", "mirrored"]]
    stacked = stack({(name,): one for name, one in forces.items()}, ["surface"])
    ratio = stacked["ratio"].mean("realization", keep_attrs=True)
    interval = student_log_interval(stacked["ratio"], confidence, "realization")
    force = stacked["pull_off_force"]
    largest = force.isel(edge_size=-1, drop=True)
    over_largest, over_interval = ratio_of_means(force, largest, confidence)
    cells = given["period"].broadcast_like(over_largest).transpose(*over_largest.dims)
    curves = xr.Dataset(
        {"logarithm": np.log(ratio), "logarithm_interval": np.log(interval), "cell": cells}
    ).assign_coords(side="large")
    edges = edges_of_curves(curves, "logarithm", logarithmic_limits(tolerance))
    of_largest = {"units": "1", "long_name": "force over that on the larger whole surface"}
    return given.assign({f"long_{name}": edge for name, edge in edges.items()}).assign(
        long_ratio=ratio,
        long_ratio_interval=interval.assign_attrs(units="1"),
        force_over_largest=over_largest.assign_attrs(of_largest),
        force_over_largest_interval=over_interval.assign_attrs(of_largest, confidence=confidence),
    )


def creases(asperities: xr.Dataset, rho: float, confidence: float) -> xr.Dataset:
    """Return how much of contact and force lies at the creases of mirrored scans, by surface.

    The dataset is asperities.nc. With intervals over scans ``crease_contact`` and ``crease_force``,
    at the range rho in nm, beside ``crease_area``; ``contact_distance``, the root mean square of
    single contacts, beside ``draw_length`` sqrt(2 R sigma/t), t the height of the apex in rms
    heights: points touch at r from it with a density of exp(-t r²/(2 R sigma)).
    """
    shares = asperities.sel(rho=rho, method="nearest", drop=True)
    names = ["crease_contact", "crease_force"]
    of_scans = shares[names].mean("contact", keep_attrs=True)
    squared = (shares["contact_distance"] ** 2).mean(["scan", "contact"])
    height, approach = shares["rms_height"].mean("scan"), shares["closest_approach"]
    draw = 2 * asperities.attrs["sphere_radius"] * height**2 / approach.mean(["scan", "contact"])
    nm = {"units": "nm"}
    found = of_scans.mean("scan", keep_attrs=True).assign(
        crease_area=shares["crease_area"].mean("scan", keep_attrs=True),
        contact_distance=(squared**0.5).assign_attrs(nm),
        draw_length=(draw**0.5).assign_attrs(nm),
    )
    for name in names:
        interval = student_interval(of_scans[name], confidence, "scan")
        found[f"{name}_interval"] = interval.clip(0, 1, keep_attrs=True)
    return found


class Trials(TypedDict):
    """Surfaces that the rule is fitted to and tested on."""

    size: float  #: Edge of a surface in nm.
    pixels: int  #: Along an edge of a surface.
    realizations: int  #: Surfaces of each spectrum.
    count: int  #: Random spectra that the rule is fitted to.
    radii: list[float]  #: Of the spheres on these, in turn, in nm.
    contacts: WindowContacts  #: Windows and contacts; the radius is that on the tested surfaces.
    excess: float  #: Factor of the force that a scan may add, for the size that is needed.
    seed: int  #: Of spectra and surfaces.
    confidence: float  #: Of intervals.


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

    ``excess`` (scan_size, rho), with its interval, is a `ratio_of_means`; ``rms_height``,
    ``roll_off`` and ``radius`` of the sphere are in nm. The name of the spectrum is for its random
    numbers.
    """
    contacts: WindowContacts = {**trials["contacts"], "radius": radius}
    pixel_size = trials["size"] / trials["pixels"]
    forces = []
    for realization in range(trials["realizations"]):
        rng = generator(trials["seed"], name, realization, "scan size")
        surface = random_surface(rng, trials["pixels"], pixel_size, spectrum)
        forces.append(window_forces(surface, contacts))
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
            "excess_interval": interval.assign_attrs(units="1"),
            "rms_height": ((), all_scales_moments(spectrum)[0], nm),
            "roll_off": ((), roll_off(spectrum), nm),
            "radius": ((), radius, nm),
        }
    )


def scan_size_trials(spectra: Mapping[str, Spectrum], trials: Trials) -> xr.Dataset:
    """Return the rule, the excess of the force that it predicts, and its error.

    Over (surface, scan_size, rho) ``excess`` with its interval and ``predicted_excess``, over
    (trial, scan_size, rho) the same of random surfaces as ``known_excess`` and
    ``predicted_known_excess``, each from a rule that was fitted without its spectrum; ``strength``
    and ``exponent`` (ratio) of the rule; ``error`` (tested, kind) of `correction_errors`;
    ``size_needed`` (surface, rho) in nm for the excess of the trials.
    """
    drawn = random_spectra(generator(trials["seed"], "scan size spectra"), trials["count"])
    known = xr.concat(
        [
            window_excess(f"random {one}", spectrum, radius, trials)
            for one, (spectrum, radius) in enumerate(zip(drawn, cycle(trials["radii"])))
        ],
        "trial",
    )
    radius = trials["contacts"]["radius"]
    tested = xr.concat(
        [window_excess(name, one, radius, trials) for name, one in spectra.items()], "surface"
    ).assign_coords(surface=list(spectra))
    (of_random, known_excess), (of_surfaces, tested_excess) = _scans(known), _scans(tested)
    rule = fitted_rule(of_random, known_excess)
    left_out = []
    for one in range(trials["count"]):
        of_others = fitted_rule(*_scans(known.drop_isel(trial=one)))
        left_out.append(of_others.excess(_scans(known.isel(trial=[one]))[0]))
    of_known = np.concatenate(left_out)
    predicted = rule.excess(of_surfaces)
    pairs = ((of_known, known_excess), (predicted, tested_excess))
    errors = [correction_errors(*pair) for pair in pairs]
    needed = rule.size_for(_scans(tested.isel(scan_size=[0]))[0], trials["excess"])
    dims, number = ("surface", "scan_size", "rho"), {"units": "1"}
    surfaces, sizes, ranges = (tested.sizes[name] for name in dims)
    return tested.assign(
        predicted_excess=(dims, predicted.reshape(surfaces, sizes, ranges), number),
        known_excess=known["excess"],
        predicted_known_excess=(("trial", *dims[1:]), of_known.reshape(-1, sizes, ranges), number),
        strength=((), rule.strength, number),
        exponent=("ratio", rule.exponents, number),
        error=(("tested", "kind"), errors, number),
        size_needed=(("surface", "rho"), needed.reshape(surfaces, ranges), {"units": "nm"}),
    ).assign_coords(
        ratio=RATIOS, tested=["random surfaces", "surfaces"], kind=["corrected", "uncorrected"]
    ).assign_attrs(
        sphere_radius=radius, surface_size=trials["size"], allowed_excess=trials["excess"],
        confidence=trials["confidence"],
    )  # fmt: skip


def _scans(excess: xr.Dataset) -> tuple[Case, Floats]:
    """Return the scans of a dataset of `window_excess`, stacked, and their factors: both flat."""
    like = excess["excess"]
    names = ("scan_size", "rms_height", "roll_off", "radius", "rho")
    lengths = (excess[name].broadcast_like(like).transpose(*like.dims) for name in names)
    return Case(*(length.values.ravel() for length in lengths)), like.values.ravel()
