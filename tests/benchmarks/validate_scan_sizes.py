"""The size that a scan needs for its force and its long edge of the band: scan_size.nc.

    nice python tests/benchmarks/validate_scan_sizes.py [--table FILE] [--processes 2]

A contact finds its peaks within some 2 sqrt(2 R sigma) of each other. A smaller scan, mirrored, has
fewer peaks, so that the sphere misses the highest of them. The excess of the force may depend on
this search size and on the roll-off, both over the size of the scan, and on the heights over the
range of adhesion. The rule is a power law of these three ratios. It is fitted to random self-affine
surfaces, which differ in rms height, roll-off, Hurst exponent and sphere, and tested on the
substitutes of the paper's surfaces, which it was not fitted to.

The long edge of the band is computed on mirrored windows and on whole random surfaces. A window
has no waves longer than its period. If a window's force changes as soon as its longest waves are
removed, the edge is open: it is at least as long.

All settings are taken from the paper's study. resources/validation/README.md describes the table.
"""

import argparse
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from itertools import cycle, islice, repeat
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike
from scan_windows import WindowFilters, Windows, filtered_window_forces, window_forces

from hardcontact.base import dataset, published
from hardcontact.base.dataset import stack
from hardcontact.base.random import generator
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import edges_of_curves
from hardcontact.surfaces.spectrum import (
    WAVEVECTORS,
    Floats,
    Spectrum,
    all_scales_rms,
    roll_off,
    self_affine,
    spectrum_of_dataset,
)
from hardcontact.surfaces.substitute_spectra import rows_of_surface, substitute_spectrum
from hardcontact.surfaces.synthesis import random_surface

RESOURCES = Path(__file__).parents[2] / "resources"
TABLE = RESOURCES / "validation/scan_size.nc"
#: Substitutes that the rule is tested on.
SURFACES = {"polished_uncd": "polished UNCD", "uncd": "UNCD", "ncd": "NCD", "mcd": "MCD"}
SEED, CONFIDENCE, TOLERANCE = 2021, 0.95, 0.1
#: Factor of the force that a scan may add, for the size that is needed.
ALLOWED_EXCESS = 1.1
#: Range of adhesion (nm) of the long edges.
RANGE = 5.6
#: Rms heights and roll-offs (nm) and Hurst exponents between which random spectra are sampled.
RMS_HEIGHTS, ROLL_OFFS, HURST = (2.0, 120.0), (300.0, 4000.0), (0.5, 1.2)
#: The ratios that the rule is a power law of.
RATIOS = ["search size / scan size", "roll-off / scan size", "rms height / range"]


@dataclass(frozen=True)
class Trials:
    """Surfaces that the rule is fitted to and tested on; lengths in nm."""

    size: float = 20e3  #: Edge of a surface.
    pixels: int = 1024  #: Along an edge of a surface.
    realizations: int = 3  #: Surfaces of each spectrum.
    spectra: int = 24  #: Random spectra that the rule is fitted to.
    radii: tuple[float, ...] = (20e3, 62.5e3, 250e3)  #: Radii of the spheres on these, in turn.
    #: Windows and contacts; the radius is for the tested surfaces.
    windows: Windows = Windows(
        sizes=[1250.0, 2500.0, 5000.0, 10e3],
        per_size=2,
        ranges=[1.4, 2.8, 5.6, 11.2],
        contact=Contact(radius=250e3, preload=10e-6, hardness=25e9, window=12.5e3, count=10),
    )


TRIALS = Trials()
#: Surfaces and windows for the long edges, with the pixels and window sizes of the trials.
FILTERS = WindowFilters(
    sizes=[20e3, 40e3],
    pixel_size=TRIALS.size / TRIALS.pixels,
    realizations=7,
    cutoffs=[300.0, 450.0, 650.0, 850.0, 1000.0, 1200.0, 1400.0, 1700.0, 2000.0, 2500.0, 3500.0,
             5000.0, 10e3],
    seed=SEED,
    windows=replace(TRIALS.windows, per_size=3, ranges=[RANGE]),
)  # fmt: skip


class Case(NamedTuple):
    """Scans of surfaces under a sphere; all lengths in nm, of shapes that broadcast."""

    size: ArrayLike  #: Side of the scan.
    rms_height: ArrayLike  #: Rms height of the surface.
    roll_off: ArrayLike  #: Roll-off wavelength of the surface.
    radius: ArrayLike  #: Radius of the sphere.
    rho: ArrayLike  #: Range of adhesion.

    def ratios(self) -> Floats:
        """Return the logarithms (3, n) of the RATIOS."""
        size, height, roll_off, radius, rho = (np.asarray(length) for length in self)
        search_size = 2 * np.sqrt(2 * radius * height)
        ratios = np.broadcast_arrays(search_size / size, roll_off / size, height / rho)
        return np.asarray(np.log(np.stack(ratios)))


class ScanSizeRule(NamedTuple):
    """A power law: ln(force on the scan / on a large one) = strength * prod(ratios**exponents)."""

    strength: float  #: Where all ratios are 1.
    exponents: Floats  #: (3,) of the RATIOS.

    def excess(self, case: Case) -> Floats:
        """Return the factor by which the force on a scan is too large."""
        logarithm = self.strength * np.exp(np.tensordot(self.exponents, case.ratios(), 1))
        return np.asarray(np.exp(logarithm))

    def size_for(self, case: Case, excess: float) -> Floats:
        """Return the side (nm) of a scan whose force is too large by a given factor.

        The size of the case does not matter.
        """
        unit_size = case._replace(size=1.0)
        logarithm = np.log(self.strength) + np.tensordot(self.exponents, unit_size.ratios(), 1)
        steepness = self.exponents[0] + self.exponents[1]
        return np.asarray(np.exp((logarithm - np.log(np.log(excess))) / steepness))


def fitted_rule(case: Case, excess: ArrayLike) -> ScanSizeRule:
    """Return the rule that fits measured factors (n,) best, by least squares of their logarithms.

    Logarithms of factors that scatter about one may be negative; they are fitted as they are.
    """
    from scipy.optimize import least_squares

    ratios, logarithms = case.ratios(), np.log(np.asarray(excess, float))

    def misfit(parameters: Floats) -> Floats:
        return np.asarray(np.exp(parameters[0] + parameters[1:] @ ratios) - logarithms)

    parameters = least_squares(misfit, np.array([np.log(0.3), 1.0, 0.0, 0.0])).x
    return ScanSizeRule(float(np.exp(parameters[0])), parameters[1:])


def correction_errors(predicted: ArrayLike, excess: ArrayLike) -> list[float]:
    """Return the root mean squares of ln(force) that are left with and without a correction.

    The correction divides measured factors (n,) by predicted factors.
    """
    uncorrected = np.log(np.asarray(excess, float))
    corrected = uncorrected - np.log(predicted)
    return [float(np.sqrt((errors**2).mean())) for errors in (corrected, uncorrected)]


def random_spectra(rng: np.random.Generator, count: int) -> list[Spectrum]:
    """Return self-affine spectra: rms height and roll-off log-uniform, Hurst exponent uniform."""
    spectra = []
    for _ in range(count):
        height = np.exp(rng.uniform(*np.log(RMS_HEIGHTS)))
        wavelength = np.exp(rng.uniform(*np.log(ROLL_OFFS)))
        shape = self_affine(WAVEVECTORS, 1.0, wavelength, rng.uniform(*HURST))
        shape_height = all_scales_rms(Spectrum(WAVEVECTORS, shape))[0]
        spectra.append(Spectrum(WAVEVECTORS, shape * (height / shape_height) ** 2))
    return spectra


def random_trials() -> tuple[list[str], list[Spectrum], list[float]]:
    """Return names, spectra and radii of the spheres (nm) of the random surfaces."""
    spectra = random_spectra(generator(SEED, "scan size spectra"), TRIALS.spectra)
    names = [f"random {trial}" for trial in range(TRIALS.spectra)]
    return names, spectra, list(islice(cycle(TRIALS.radii), TRIALS.spectra))


def ratio_of_means(
    forces: xr.DataArray, reference: xr.DataArray
) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the mean force over realizations relative to a reference, and its interval.

    The interval comes from Student's t of the logarithms of the ratios of single realizations; it
    is centred at the ratio of the means.
    """
    ratio = forces.mean("realization") / reference.mean("realization")
    single = forces / reference
    interval = student_log_interval(single, CONFIDENCE, "realization")
    return ratio.assign_attrs(units="1"), ratio * interval / single.mean("realization")


def window_excess(name: str, spectrum: Spectrum, radius: float, trials: Trials) -> xr.Dataset:
    """Return the force on windows relative to whole surfaces of a spectrum.

    ``finite_scan_ratio`` (scan_size, rho), with its interval, is a `ratio_of_means`;
    ``rms_height``, ``rolloff`` and ``radius`` of the sphere are in nm. The name of the spectrum is
    for its random numbers.
    """
    windows = replace(trials.windows, contact=replace(trials.windows.contact, radius=radius))
    forces = []
    for realization in range(trials.realizations):
        rng = generator(SEED, name, realization, "scan size")
        surface = random_surface(rng, trials.pixels, trials.size / trials.pixels, spectrum)
        forces.append(window_forces(surface, windows))
    force = xr.DataArray(
        forces,
        {"scan_size": [*windows.sizes, trials.size], "rho": windows.ranges},
        ["realization", "scan_size", "rho"],
    )
    window_force, surface_force = (
        force.isel(scan_size=slice(-1)),
        force.isel(scan_size=-1, drop=True),
    )
    excess, interval = ratio_of_means(window_force, surface_force)
    nm = {"units": "nm"}
    return xr.Dataset(
        {
            "finite_scan_ratio": excess,
            "finite_scan_ratio_interval": interval.assign_attrs(units="1"),
            "rms_height": ((), all_scales_rms(spectrum)[0], nm),
            "rolloff": ((), roll_off(spectrum), nm),
            "radius": ((), radius, nm),
        }
    )


def apply_rule(tested: xr.Dataset, random_surfaces: xr.Dataset) -> xr.Dataset:
    """Return the rule, the excess of the force that it predicts, and its error.

    Parameters
    ----------
    tested : `window_excess` over (surface, scan_size, rho)
    random_surfaces : `window_excess` over (trial, scan_size, rho), to fit the rule to

    Returns
    -------
    The tested excess with ``predicted_finite_scan_ratio``, over the same dimensions;
    ``trial_finite_scan_ratio`` and ``predicted_trial_finite_scan_ratio`` over the dimensions of the
    random surfaces, each predicted by a rule that was fitted without its spectrum; ``rule_factor``
    and ``exponent`` (exponent_of) of the rule; ``rms_log_error`` (tested_on, correction), the
    `correction_errors`; ``size_needed`` (surface, rho) in nm for ALLOWED_EXCESS.
    """
    random_cases, random_excess = _cases(random_surfaces)
    surface_cases, tested_excess = _cases(tested)
    rule = fitted_rule(random_cases, random_excess)
    left_out = []
    for trial in range(random_surfaces.sizes["trial"]):
        rule_of_others = fitted_rule(*_cases(random_surfaces.drop_isel(trial=trial)))
        left_out.append(rule_of_others.excess(_cases(random_surfaces.isel(trial=[trial]))[0]))
    predicted_random = np.concatenate(left_out)
    predicted = rule.excess(surface_cases)
    errors = [
        correction_errors(predicted_random, random_excess),
        correction_errors(predicted, tested_excess),
    ]
    needed = rule.size_for(_cases(tested.isel(scan_size=[0]))[0], ALLOWED_EXCESS)
    axes, unitless = ("surface", "scan_size", "rho"), {"units": "1"}
    surfaces, sizes, ranges = (tested.sizes[name] for name in axes)
    predicted_by_trial = predicted_random.reshape(-1, sizes, ranges)
    return tested.assign(
        predicted_finite_scan_ratio=(axes, predicted.reshape(surfaces, sizes, ranges), unitless),
        trial_finite_scan_ratio=random_surfaces["finite_scan_ratio"],
        predicted_trial_finite_scan_ratio=(("trial", *axes[1:]), predicted_by_trial, unitless),
        rule_factor=((), rule.strength, unitless),
        exponent=("exponent_of", rule.exponents, unitless),
        rms_log_error=(("tested_on", "correction"), errors, unitless),
        size_needed=(("surface", "rho"), needed.reshape(surfaces, ranges), {"units": "nm"}),
    ).assign_coords(
        exponent_of=RATIOS,
        tested_on=["random surfaces", "surfaces"],
        correction=["corrected", "uncorrected"],
        scan_size=tested["scan_size"].assign_attrs(units="nm"),
        rho=tested["rho"].assign_attrs(units="nm"),
    )


def _cases(excess: xr.Dataset) -> tuple[Case, Floats]:
    """Return scans and factors of a result of `window_excess`, both flat."""
    factors = excess["finite_scan_ratio"]
    names = ("scan_size", "rms_height", "rolloff", "radius", "rho")
    lengths = (excess[name].broadcast_like(factors).transpose(*factors.dims) for name in names)
    return Case(*(length.values.ravel() for length in lengths)), factors.values.ravel()


def window_edges(forces: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the long edges of the band from windows and whole surfaces, and the forces on them.

    The argument is a mapping from surfaces to results of `filtered_window_forces`. With intervals:
    ``filtered_force_ratio`` (surface, map_size, cutoff_wavelength), the mean over realizations of
    the force without longer waves relative to the force with all, and ``force_over_largest``
    (surface, map_size), the force relative to the larger whole surface. Edges of each map size have
    names that begin with ``long_``. ``period`` and ``mirrored`` are copied from the forces.
    """
    windows = next(iter(forces.values()))[["period", "mirrored"]]
    all_forces = stack(
        {(name,): forces_on_one for name, forces_on_one in forces.items()}, ["surface"]
    )
    ratio = all_forces["filtered_force_ratio"].mean("realization", keep_attrs=True)
    interval = student_log_interval(all_forces["filtered_force_ratio"], CONFIDENCE, "realization")
    force = all_forces["pull_off_force"]
    relative_force, relative_interval = ratio_of_means(force, force.isel(map_size=-1, drop=True))
    ratios = xr.Dataset(
        {"filtered_force_ratio": ratio, "filtered_force_ratio_interval": interval}
    ).assign_coords(side="large")
    edges = edges_of_curves(ratios, TOLERANCE)
    attributes = {"units": "1", "long_name": "force relative to that on the larger whole surface"}
    return windows.assign({f"long_{name}": edge for name, edge in edges.items()}).assign(
        filtered_force_ratio=ratio,
        filtered_force_ratio_interval=interval.assign_attrs(units="1"),
        force_over_largest=relative_force.assign_attrs(attributes),
        force_over_largest_interval=relative_interval.assign_attrs(
            attributes, confidence=CONFIDENCE
        ),
    )


def study_spectrum(surface: str) -> Spectrum:
    """Return the spectrum of the substitute for a surface, as the paper's study calibrates it."""
    table1 = published.table1(RESOURCES / "paper/table1.csv")
    rows = rows_of_surface(table1, surface)
    constants = published.constants(RESOURCES / "paper/parameters.csv")
    stored_spectrum = substitute_spectrum(RESOURCES / f"spectra/{surface}.csv", rows, constants)
    return spectrum_of_dataset(stored_spectrum)


def main() -> None:
    """Compute the table from nothing."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--table", type=Path, default=TABLE)
    parser.add_argument("--processes", type=int, default=2)
    arguments = parser.parse_args()
    spectra = {surface: study_spectrum(surface) for surface in SURFACES}
    with ProcessPoolExecutor(arguments.processes) as pool:
        edges = pool.map(filtered_window_forces, SURFACES, spectra.values(), repeat(FILTERS))
        random_surfaces = pool.map(window_excess, *random_trials(), repeat(TRIALS))
        radii = [TRIALS.windows.contact.radius] * len(SURFACES)
        tested = pool.map(window_excess, SURFACES, spectra.values(), radii, repeat(TRIALS))
        forces = dict(zip(SURFACES, edges, strict=True))
        surfaces = xr.concat(tested, pd.Index(list(SURFACES), name="surface"))
        table = apply_rule(surfaces, xr.concat(random_surfaces, "trial")).merge(
            window_edges(forces)
        )
    table = table.assign(
        label=("surface", list(SURFACES.values())),
        basis=("surface", ["substitute"] * len(SURFACES)),
    ).assign_attrs(
        title="forces and long edges on mirrored windows of random surfaces, and the rule fitted",
        history="computed by tests/benchmarks/validate_scan_sizes.py",
        sphere_radius=TRIALS.windows.contact.radius, surface_size=TRIALS.size, rho=RANGE,
        tolerance=TOLERANCE, allowed_ratio=ALLOWED_EXCESS, confidence=CONFIDENCE,
    )  # fmt: skip
    dataset.write(table, arguments.table)


if __name__ == "__main__":
    main()
