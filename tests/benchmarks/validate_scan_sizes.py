"""Forces and long edges of the band on mirrored scans of random surfaces: scan_size.nc.

    nice python tests/benchmarks/validate_scan_sizes.py [--table FILE] [--processes 2]

A mirrored scan has fewer summits than a large surface, so that the sphere misses the highest of
them. A scan also has no waves longer than its period. If its force changes as soon as its longest
waves are removed, the long edge is open: it is at least as long.

All settings are taken from the paper's study. resources/validation/README.md describes the table.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from hardcontact.base import published
from hardcontact.base.arrays import generator
from hardcontact.base.dataset import stack, write_dataset
from hardcontact.base.statistics import student_log_interval
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import count_window_pixels
from hardcontact.contact.pull_off import FORCE_ATTRS, make_force_function
from hardcontact.inference.edges import edges_of_ratios
from hardcontact.surfaces.filters import filtered_series
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.substitute_spectra import substitute_spectrum
from hardcontact.surfaces.synthesis import random_surface

RESOURCES = Path(__file__).parents[2] / "resources"
TABLE = RESOURCES / "validation/scan_size.nc"
#: Substitutes whose random surfaces are cut into scans.
SURFACES = {"polished_uncd": "polished UNCD", "uncd": "UNCD", "ncd": "NCD", "mcd": "MCD"}
CONFIDENCE, TOLERANCE, SEED = 0.95, 0.1, 2021
#: Widths (nm) of two whole surfaces.
SURFACE_SIZES = [20e3, 40e3]
#: Widths (nm) of scans along the diagonal of the second one.
SCAN_SIZES = [1250.0, 2500.0, 5000.0, 10e3]
SCAN_COUNT = 3  # of each size, for each realization
PIXEL_SIZE, REALIZATIONS = 20e3 / 1024, 7  # pixel size in nm
#: Longer waves are removed.
CUTOFFS = [
    300.0, 450.0, 650.0, 850.0, 1000.0, 1200.0, 1400.0, 1700.0, 2000.0, 2500.0, 3500.0, 5000.0,
    10e3,
]  # fmt: skip
CONTACT = Contact(
    radius=250e3, preload=10e-6, hardness=25e9, window=12.5e3, contacts_per_row=10, rho=5.6
)
#: Mirrored scans hold few summits, so that half as many contacts per row suffice.
SCAN_CONTACT = replace(CONTACT, contacts_per_row=5)


def mirrored_scans(surface, size):
    """Yield levelled scans of a width (nm), mirrored so that their period is twice this width."""
    pixels = round(size / surface.pixel_size)
    for start in np.arange(SCAN_COUNT) * (surface.pixels // SCAN_COUNT):
        shifted_heights = np.roll(surface.heights, (-start, -start), (0, 1))
        heights = shifted_heights[:pixels, :pixels].astype(float)
        yield mirror_scan(level_plane(replace(surface, heights=heights, periodic=False)))


def mean_force(surface, contact):
    """Return the mean plastic pull-off force in N at 1 J/m² on a periodic surface."""
    return make_force_function(contact)(surface).mean()


def force_and_ratios(surface, contact):
    """Return the mean force and its ratios without long waves, (1 + cutoff,).

    A cutoff above the period removes nothing, which does not show that longer waves do not matter:
    its ratio is NaN.
    """
    cutoffs = [cutoff for cutoff in CUTOFFS if cutoff <= surface.size * (1 + 1e-12)]
    surfaces = filtered_series(surface, "long", [None, *cutoffs], surface.pixels)
    force, *filtered = (mean_force(filtered_surface, contact) for filtered_surface in surfaces)
    missing_ratios = [np.nan] * (len(CUTOFFS) - len(cutoffs))
    return np.array([force, *(value / force for value in filtered), *missing_ratios])


def realization_forces(name, spectrum, realization):
    """Return the mean `force_and_ratios` on scans of every size, then those on whole surfaces."""
    surfaces = []
    for size in SURFACE_SIZES:
        rng = generator(SEED, name, realization, f"window edges {size:g} nm")
        pixels = count_window_pixels(size, PIXEL_SIZE)
        surfaces.append(random_surface(rng, pixels, PIXEL_SIZE, spectrum))
    means = [
        np.mean([force_and_ratios(scan, SCAN_CONTACT) for scan in scans], axis=0)
        for scans in (mirrored_scans(surfaces[-1], size) for size in SCAN_SIZES)
    ]
    return [*means, *(force_and_ratios(surface, CONTACT) for surface in surfaces)]


def surface_forces(name):
    """Return the forces (realization, map_size) on a substitute, and the ratios at the cutoffs."""
    rows = published.rows_of_surface(published.read_table1(RESOURCES / "paper/table1.csv"), name)
    constants = published.read_constants(RESOURCES / "paper/constants.csv")
    stored_spectrum = substitute_spectrum(RESOURCES / f"spectra/{name}.csv", rows, constants)
    spectrum = spectrum_of_dataset(stored_spectrum)
    means = np.array([realization_forces(name, spectrum, k) for k in range(REALIZATIONS)])
    axes = ("realization", "map_size")
    ratio_name = "force without longer waves, relative to the force with all waves"
    ratio_attributes = {"units": "1", "long_name": ratio_name}
    return xr.Dataset(
        {
            "pull_off_force": (axes, means[..., 0], FORCE_ATTRS),
            "filtered_force_ratio": (
                (*axes, "cutoff_wavelength"), means[..., 1:], ratio_attributes
            ),
        }
    )  # fmt: skip


def long_edges(all_forces):
    """Return means over realizations (surface, map_size) with intervals, and the long edges."""
    ratio = all_forces["filtered_force_ratio"].mean("realization", keep_attrs=True)
    interval = student_log_interval(all_forces["filtered_force_ratio"], CONFIDENCE, "realization")
    ratios = xr.Dataset({"filtered_force_ratio": ratio, "filtered_force_ratio_interval": interval})
    edges = edges_of_ratios(ratios.assign_coords(side="long"), TOLERANCE)
    force = all_forces["pull_off_force"]
    largest = force.isel(map_size=-1, drop=True)
    relative_force = force.mean("realization") / largest.mean("realization")
    # Student's t of the ratios of single realizations, centred at the ratio of the means.
    single_ratios = force / largest
    relative_interval = student_log_interval(single_ratios, CONFIDENCE, "realization")
    relative_interval = relative_force * relative_interval / single_ratios.mean("realization")
    attributes = {"units": "1", "long_name": "force relative to that on the larger whole surface"}
    return xr.Dataset({f"long_{name}": edge for name, edge in edges.items()}).assign(
        filtered_force_ratio=ratio,
        filtered_force_ratio_interval=interval.assign_attrs(units="1"),
        force_over_largest=relative_force.assign_attrs(attributes),
        force_over_largest_interval=relative_interval.assign_attrs(
            attributes, confidence=CONFIDENCE
        ),
    )


def described_table(all_forces):
    """Return the table of the forces of all surfaces, with its coordinates and attributes."""
    lengths = {
        "map_size": (
            [*SCAN_SIZES, *SURFACE_SIZES],
            "size of the mirrored scans, then of whole surfaces",
        ),
        "cutoff_wavelength": (CUTOFFS, "wavelength above which roughness is removed"),
    }
    coordinates = {
        name: (name, values, {"units": "nm", "long_name": meaning})
        for name, (values, meaning) in lengths.items()
    }
    mirrored = [1] * len(SCAN_SIZES) + [0] * len(SURFACE_SIZES)
    mirrored_attributes = {
        "units": "1", "long_name": "1 for mirrored scans, 0 for whole surfaces"
    }  # fmt: skip
    periods = [*(2 * size for size in SCAN_SIZES), *SURFACE_SIZES]
    period_attributes = {"units": "nm", "long_name": "longest wave of the surface"}
    table = long_edges(all_forces.assign_coords(coordinates))
    return table.assign(
        period=("map_size", periods, period_attributes),
        mirrored=("map_size", mirrored, mirrored_attributes),
        label=("surface", list(SURFACES.values())),
        source=("surface", ["substitute"] * len(SURFACES)),
    ).assign_attrs(
        title="forces and long edges on mirrored scans of random surfaces",
        history="computed by tests/benchmarks/validate_scan_sizes.py",
        sphere_radius=CONTACT.radius, rho=CONTACT.rho,
        tolerance=TOLERANCE, confidence=CONFIDENCE,
    )  # fmt: skip


def main():
    """Compute and write the whole table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--table", type=Path, default=TABLE)
    parser.add_argument("--processes", type=int, default=2)
    arguments = parser.parse_args()
    with ProcessPoolExecutor(arguments.processes) as pool:
        forces = zip(SURFACES, pool.map(surface_forces, SURFACES), strict=True)
        all_forces = stack({(name,): data for name, data in forces}, ["surface"])
    write_dataset(described_table(all_forces), arguments.table)


if __name__ == "__main__":
    main()
