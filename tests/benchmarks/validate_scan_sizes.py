"""Forces and long edges of the band on mirrored windows of random surfaces: scan_size.nc.

    nice python tests/benchmarks/validate_scan_sizes.py [--table FILE] [--processes 2]

A mirrored window has fewer peaks than a large surface, so that the sphere misses the highest of
them. A window also has no waves longer than its period. If its force changes as soon as its longest
waves are removed, the long edge is open: it is at least as long.

All settings are taken from the paper's study. resources/validation/README.md describes the table.
"""

import argparse
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from itertools import repeat
from pathlib import Path

import numpy as np
import xarray as xr

from hardcontact.base import dataset, published
from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.random import generator
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies, window_pixels
from hardcontact.contact.pull_off import FORCE_ATTRS, mean_pull_off_dataset
from hardcontact.own.edges_of_scans import edges_of_curves
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import HeightMap, mirror_stitch
from hardcontact.surfaces.levelling import level
from hardcontact.surfaces.spectrum import Spectrum, SpectrumFunction, spectrum_of_dataset
from hardcontact.surfaces.substitute_spectra import substitute_spectrum
from hardcontact.surfaces.synthesis import cut_scan, random_surface

RESOURCES = Path(__file__).parents[2] / "resources"
TABLE = RESOURCES / "validation/scan_size.nc"
#: Substitutes whose random surfaces are cut into windows.
SURFACES = {"polished_uncd": "polished UNCD", "uncd": "UNCD", "ncd": "NCD", "mcd": "MCD"}
CONFIDENCE, TOLERANCE = 0.95, 0.1
#: Range of adhesion in nm.
RANGE = 5.6


@dataclass(frozen=True)
class Windows:
    """Windows that are cut out of a surface, and the contacts on them; lengths in nm."""

    sizes: list[float]  #: Edges of the windows.
    per_size: int  #: Windows of every size, along the diagonal of the surface.
    ranges: list[float]  #: Ranges of adhesion.
    contact: Contact  #: Contacts of a smooth sphere; their range is not used.


@dataclass(frozen=True)
class WindowFilters:
    """Random surfaces, the windows cut out of them, and the cutoffs; lengths in nm."""

    sizes: list[float]  #: Edges of two whole surfaces; windows are cut out of the second.
    pixel_size: float
    realizations: int  #: Surfaces of each size.
    cutoffs: list[float]  #: Ascending; wavelengths above are removed.
    seed: int
    #: At one range of adhesion, with the contacts on whole surfaces. Mirrored windows hold few
    #: peaks, so that half as many contacts per row suffice there.
    windows: Windows


#: Surfaces, windows and contacts.
FILTERS = WindowFilters(
    sizes=[20e3, 40e3],
    pixel_size=20e3 / 1024,
    realizations=7,
    cutoffs=[300.0, 450.0, 650.0, 850.0, 1000.0, 1200.0, 1400.0, 1700.0, 2000.0, 2500.0, 3500.0,
             5000.0, 10e3],
    seed=2021,
    windows=Windows(
        sizes=[1250.0, 2500.0, 5000.0, 10e3],
        per_size=3,
        ranges=[RANGE],
        contact=Contact(
            radius=250e3, preload=10e-6, hardness=25e9, window=12.5e3, contacts_per_row=10
        ),
    ),
)  # fmt: skip


def mirrored_windows(surface: HeightMap, size: float, count: int) -> Iterator[HeightMap]:
    """Yield levelled and mirrored windows of a periodic surface, along its diagonal.

    Windows have the edge `size` (nm); mirrored they are periodic over twice that size.
    """
    pixels = round(size / surface.pixel_size)
    for start in np.arange(count) * (surface.pixels // count):
        shifted = replace(surface, heights=np.roll(surface.heights, (-start, -start), (0, 1)))
        yield mirror_stitch(level(cut_scan(shifted, pixels)))


def mean_forces(surface: HeightMap, windows: Windows) -> Floats:
    """Return the plastic pull-off (rho,) in N at 1 J/m² on a periodic surface, over contacts."""
    pair = join_bodies(surface, None, windows.contact)
    forces = mean_pull_off_dataset(pair, windows.contact, windows.ranges)["pull_off_force"]
    return np.asarray(forces.sel(contact_model="plastic").values)


def filtered_forces(surface: HeightMap, cutoffs: list[float], windows: Windows) -> Floats:
    """Return the mean force on a periodic surface and the ratios to it without long waves.

    The values are (1 + cutoff,): the force in N at 1 J/m² at the first range of adhesion, then the
    ratios at the cutoffs (nm, ascending). A cutoff above the period removes nothing, which does not
    show that longer waves do not matter: its ratio is NaN.
    """
    limit = surface.size * (1 + 1e-12)
    passed_cutoffs = [cutoff for cutoff in cutoffs if cutoff <= limit]
    surfaces = filtered_series(surface, "long", [None, *passed_cutoffs], surface.pixels)
    force, *filtered = (mean_forces(filtered_surface, windows)[0] for filtered_surface in surfaces)
    missing_ratios = [np.nan] * (len(cutoffs) - len(passed_cutoffs))
    return np.array([force, *(value / force for value in filtered), *missing_ratios])


def filtered_window_forces(
    name: str, spectrum: SpectrumFunction, filters: WindowFilters
) -> xr.Dataset:
    """Return the forces on windows and whole surfaces of a spectrum, with and without long waves.

    The name is for random numbers, C_iso in nm⁴. Forces (realization, map_size) and the ratios at
    the cutoffs are means over windows, those of windows before those of whole surfaces.
    """
    realizations = range(filters.realizations)
    means = np.array([_realization_forces(name, spectrum, filters, k) for k in realizations])
    window_sizes, surface_sizes = filters.windows.sizes, filters.sizes
    nm, axes = {"units": "nm"}, ("realization", "map_size")
    periods = [*(2 * size for size in window_sizes), *surface_sizes]
    ratio_attributes = {
        "units": "1",
        "long_name": "force without longer waves, relative to the force with all waves",
    }
    mirrored_attributes = {
        "units": "1",
        "long_name": "1 for mirrored windows, 0 for whole surfaces",
    }
    cutoff_attributes = nm | {"long_name": "wavelength above which roughness is removed"}
    return xr.Dataset(
        {
            "pull_off_force": (axes, means[..., 0], FORCE_ATTRS),
            "filtered_force_ratio": (
                (*axes, "cutoff_wavelength"),
                means[..., 1:],
                ratio_attributes,
            ),
            "period": ("map_size", periods, nm | {"long_name": "longest wave of the surface"}),
            "mirrored": (
                "map_size",
                [1] * len(window_sizes) + [0] * len(surface_sizes),
                mirrored_attributes,
            ),
        },
        {
            "map_size": (
                "map_size",
                [*window_sizes, *surface_sizes],
                nm | {"long_name": "size of the mirrored windows, then of the whole surfaces"},
            ),
            "cutoff_wavelength": ("cutoff_wavelength", filters.cutoffs, cutoff_attributes),
        },
    )


def _realization_forces(
    name: str, spectrum: SpectrumFunction, filters: WindowFilters, realization: int
) -> list[Floats]:
    """Return the mean `filtered_forces` of windows of every size, then those of whole surfaces."""
    windows, cutoffs, pixel_size = filters.windows, filters.cutoffs, filters.pixel_size
    half_as_many = replace(
        windows.contact, contacts_per_row=-(-windows.contact.contacts_per_row // 2)
    )
    fewer_contacts = replace(windows, contact=half_as_many)
    surfaces = []
    for size in filters.sizes:
        rng = generator(filters.seed, name, realization, f"window edges {size:g} nm")
        pixels = window_pixels(size, pixel_size)
        surfaces.append(random_surface(rng, pixels, pixel_size, spectrum))
    means = []
    for size in windows.sizes:
        scans = mirrored_windows(surfaces[-1], size, windows.per_size)
        forces = [filtered_forces(scan, cutoffs, fewer_contacts) for scan in scans]
        means.append(np.mean(forces, axis=0))
    return [*means, *(filtered_forces(surface, cutoffs, windows) for surface in surfaces)]


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


def window_edges(forces: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the long edges of the band from windows and whole surfaces, and the forces on them.

    From results of `filtered_window_forces` by surface: means over realizations with intervals,
    and the edges of each map size, whose names begin with ``long_``.
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
    ).assign_coords(side="long")
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
    table1 = published.read_table1(RESOURCES / "paper/table1.csv")
    rows = published.rows_of_surface(table1, surface)
    constants = published.read_constants(RESOURCES / "paper/parameters.csv")
    stored_spectrum = substitute_spectrum(RESOURCES / f"spectra/{surface}.csv", rows, constants)
    return spectrum_of_dataset(stored_spectrum)


def main() -> None:
    """Compute the table from nothing."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--table", type=Path, default=TABLE)
    parser.add_argument("--processes", type=int, default=2)
    arguments = parser.parse_args()
    spectra = [study_spectrum(surface) for surface in SURFACES]
    with ProcessPoolExecutor(arguments.processes) as pool:
        forces = pool.map(filtered_window_forces, SURFACES, spectra, repeat(FILTERS))
        table = window_edges(dict(zip(SURFACES, forces, strict=True)))
    table = table.assign(
        label=("surface", list(SURFACES.values())),
        basis=("surface", ["substitute"] * len(SURFACES)),
    ).assign_attrs(
        title="forces and long edges on mirrored windows of random surfaces",
        history="computed by tests/benchmarks/validate_scan_sizes.py",
        sphere_radius=FILTERS.windows.contact.radius, rho=RANGE,
        tolerance=TOLERANCE, confidence=CONFIDENCE,
    )  # fmt: skip
    dataset.write(table, arguments.table)


if __name__ == "__main__":
    main()
