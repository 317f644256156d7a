"""Forces and long edges of the band on mirrored windows of random surfaces: scan_size.nc.

    nice python tests/benchmarks/validate_scan_sizes.py [--table FILE] [--processes 2]

A mirrored window has fewer peaks than a large surface, so that the sphere misses the highest of
them. A window also has no waves longer than its period. If its force changes as soon as its longest
waves are removed, the long edge is open: it is at least as long.

All settings are taken from the paper's study. resources/validation/README.md describes the table.
"""

import argparse
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat
from pathlib import Path

import xarray as xr
from scan_windows import WindowFilters, Windows, filtered_window_forces

from hardcontact.base import dataset, published
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import edges_of_curves
from hardcontact.surfaces.spectrum import Spectrum, spectrum_of_dataset
from hardcontact.surfaces.substitute_spectra import rows_of_surface, substitute_spectrum

RESOURCES = Path(__file__).parents[2] / "resources"
TABLE = RESOURCES / "validation/scan_size.nc"
#: Substitutes whose random surfaces are cut into windows.
SURFACES = {"polished_uncd": "polished UNCD", "uncd": "UNCD", "ncd": "NCD", "mcd": "MCD"}
CONFIDENCE, TOLERANCE = 0.95, 0.1
#: Range of adhesion in nm.
RANGE = 5.6
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
        contact=Contact(radius=250e3, preload=10e-6, hardness=25e9, window=12.5e3, count=10),
    ),
)  # fmt: skip


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
