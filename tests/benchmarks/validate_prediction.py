"""The closed form and computed forces and edges on designed surfaces: designed_surfaces.csv.

    python tests/benchmarks/validate_prediction.py [--surfaces 160] [--table FILE]

Forces and edges are computed as the study computes them: on random surfaces, in plastic contact,
filtered at cutoffs. Existing rows of the table are only predicted again. A run therefore continues
an earlier one, and without `--surfaces` a changed closed form is tested on the same surfaces.
The columns are described in resources/validation/README.md.
"""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy.stats import qmc

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import (
    CUTOFF,
    edge_intervals,
    edges_or_bounds,
    find_edges,
    logarithmic_limits,
)
from hardcontact.inference.forces_on_masters import Filters, filtered_pull_off
from hardcontact.surfaces.spectral_models import self_affine, varying_hurst
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.synthesis import SIDES, random_surface
from hardcontact.theory.closed_form import closed_form, critical_band
from hardcontact.theory.summits import spectrum_between
from hardcontact.theory.validity import table_point

TABLE = Path(__file__).parents[2] / "workflow/hardcontact/theory/designed_surfaces.csv"
SEED, WORK, HARDNESS, TOLERANCE = 20261123, 1.0, 25e9, 0.1  # work in J/m², hardness in Pa
CONTACTS_PER_ROW, CUTOFF_COUNT = 8, 12
#: Limits of each input, sampled evenly in its logarithm except for Hurst exponent and kind; lengths
#: in nm, the area of contact in nm².
BOUNDS = {
    "rolloff": (200.0, 4000.0),
    "steepness": (1 / 300, 1 / 20),  # rms height over roll-off
    "hurst": (0.4, 0.95),
    "radius": (5e3, 1e6),
    "rho": (0.5, 20.0),
    "area": (50.0, 5000.0),
    "kind": (0.0, 1.0),
}
#: Kinds of spectra, and the share of the surfaces up to each.
KINDS = {"self-affine": 0.4, "two slopes": 0.6, "bump": 0.8, "bent": 1.0}
#: A second design with the spectra that the first one lacks, all of one kind: the Hurst exponent at
#: the roll-off, and its change a decade below.
STEEP = "steep"
STEEP_SEED = 20261125
STEEP_BOUNDS = {name: ends for name, ends in BOUNDS.items() if name != "kind"} | {
    "hurst": (1.0, 1.9),
    "hurst_change": (-0.7, 0.7),
}
#: Surfaces of both designs.
FIRST_COUNT, SECOND_COUNT = 96, 64
#: Largest size of a surface in nm.
MAX_SIZE = 25e3
#: Realizations of a surface, by its pixels.
GRIDS = {1024: 4, 2048: 3}


def design():
    """Return the inputs of all surfaces of both designs."""
    first_rows = sample_inputs(BOUNDS, SEED, FIRST_COUNT)
    second_rows = [
        row | {"surface": FIRST_COUNT + row["surface"], "kind": STEEP}
        for row in sample_inputs(STEEP_BOUNDS, STEEP_SEED, SECOND_COUNT)
    ]
    return [row | grid(row) for row in [*first_rows, *second_rows]]


def sample_inputs(bounds, seed, count):
    """Yield the inputs of the first `count` surfaces of a scrambled Sobol sequence in bounds."""
    points = qmc.Sobol(len(bounds), rng=np.random.default_rng(seed)).random_base2(7)[:count]
    for number, point in enumerate(points):
        row = {"surface": number, "held_out": number // 2 % 2}  # every second pair is held out
        for (name, (low, high)), share in zip(bounds.items(), point, strict=True):
            is_linear = name in ("hurst", "hurst_change", "kind")
            row[name] = low + share * (high - low) if is_linear else low * (high / low) ** share
        if "kind" in row:
            row["kind"] = next(kind for kind, end in KINDS.items() if row["kind"] <= end)
        row["rms_height"] = row["rolloff"] * row.pop("steepness")
        yield row


def grid(row):
    """Return the grid that holds the waves that matter, and the area of whole pixels on it.

    If such a grid exists, the root of the contact area is at least twelve pixels long, and the
    surface at least as wide as three roll-offs and six times the `summit_distance`.
    """
    # Here the sphere is a third of the rms height above its apex.
    summit_distance = np.sqrt(2 * row["radius"] * row["rms_height"] / 3)
    wanted_size = max(3 * row["rolloff"], 6 * summit_distance)
    size = min(wanted_size, MAX_SIZE)
    wanted_pixel_size = np.sqrt(row["area"]) / 12
    pixels = next((n for n in GRIDS if size / n <= wanted_pixel_size), max(GRIDS))
    pixel_size = size / pixels
    preload = row["area"] * HARDNESS * 1e-18
    contact = Contact(radius=row["radius"], preload=preload, hardness=HARDNESS)
    is_coarse, is_small = pixel_size > 3 * wanted_pixel_size, size < wanted_size / 2
    return {
        "size": size,
        "pixels": pixels,
        "shortest": 4 * pixel_size,
        "area": contact.pixel_count(pixel_size) * pixel_size**2,
        "missing_waves": "short" if is_coarse else "long" if is_small else "nothing",
    }


def spectrum_of(row):
    """Return C_iso of a row: its kind, of its rms height, without waves below the shortest."""
    hurst, rolloff = row["hurst"], row["rolloff"]
    density = self_affine(WAVEVECTORS, 1.0, rolloff, hurst)
    relative_wavevectors = WAVEVECTORS * rolloff / (2 * np.pi)
    if row["kind"] == "two slopes":  # below an eighth of the roll-off, H is 1.35 - hurst
        density = density * np.maximum(relative_wavevectors / 8, 1) ** (2 * (2 * hurst - 1.35))
    if row["kind"] == "bump":  # grains of a sixth of the roll-off quadruple the density there
        bump = np.exp(-(np.log(relative_wavevectors / 6) ** 2) / (2 * 0.3**2))
        density = density * (1 + 3 * bump)
    if row["kind"] == "bent":
        density = varying_hurst(WAVEVECTORS, 1.0, rolloff, hurst - 0.4, 0.4)
    if row["kind"] == STEEP:
        density = varying_hurst(WAVEVECTORS, 1.0, rolloff, hurst, row["hurst_change"])
    density = np.where(2 * np.pi / WAVEVECTORS >= row["shortest"], density, 0.0)
    rms_height = np.sqrt(np.trapezoid(density * WAVEVECTORS**2, np.log(WAVEVECTORS)) / (2 * np.pi))
    return Spectrum(WAVEVECTORS, density * (row["rms_height"] / rms_height) ** 2)


def compute_row(row):
    """Return the mean force (N at 1 J/m²), the standard error of its logarithm, and both edges."""
    spectrum, size, pixels = spectrum_of(row), row["size"], row["pixels"]
    # From nearly the shortest wave to about half the width of the surface.
    cutoffs = np.geomspace(1.15 * row["shortest"], size / 2.2, CUTOFF_COUNT)
    # At the ends of this width the sphere is 18 ranges, or 18 rms heights, above its apex.
    attraction_width = 12 * np.sqrt(row["radius"] * max(row["rho"], row["rms_height"]))
    contact = Contact(
        radius=row["radius"],
        preload=row["area"] * HARDNESS * 1e-18,
        hardness=HARDNESS,
        window=max(attraction_width, 32 * size / pixels),
        contacts_per_row=CONTACTS_PER_ROW,
        rho=row["rho"],
    )
    curves = {side: [] for side in SIDES}
    forces = []
    for realization in range(GRIDS[pixels]):
        rng = generator(SEED, row["surface"], realization, "validation")
        surface = random_surface(rng, pixels, size / pixels, spectrum)
        for side in SIDES:
            filtered_forces = filtered_pull_off(surface, Filters(side, pixels, cutoffs), [contact])
            filtered_forces = filtered_forces.mean(["contact_y", "contact_x"])
            unfiltered_force = filtered_forces["unfiltered_pull_off_force"].item()
            curves[side].append(filtered_forces["pull_off_force"].values.ravel() / unfiltered_force)
        forces.append(unfiltered_force)
    error = np.std(np.log(forces), ddof=1) / np.sqrt(len(forces))
    result = {"force": np.mean(forces), "force_error": error}
    for side in SIDES:
        result |= describe_edge(side, cutoffs, np.array(curves[side]))
    return result


def describe_edge(side, cutoffs, ratios):
    """Return the columns of an edge, or its bound, from force ratios (realization, cutoff)."""
    log_ratios = np.log([ratios.mean(axis=0), ratios.min(axis=0), ratios.max(axis=0)])
    coordinates = {CUTOFF: cutoffs, "side": side}
    curve, lowest, highest = xr.DataArray(log_ratios, coordinates, ("statistic", CUTOFF))
    limits = logarithmic_limits(TOLERANCE)
    edge = find_edges(curve, limits)
    low, high = edge_intervals(curve, lowest, highest, limits).values
    status = {"found": "found", "open_above": "at least", "open_below": "at most"}
    return {
        f"{side}_edge": edges_or_bounds(edge).item(),
        f"{side}_edge_status": status[edge["edge_status"].item()],
        f"{side}_edge_low": low,
        f"{side}_edge_high": high,
    }


def spectrum_of_grid(spectrum, size, pixels):
    """Return the spectrum of the waves that a periodic surface can have.

    They fill a square up to the Nyquist wavevector (rad/nm) but for the cell at zero; the spectrum
    ends at circles of the same areas. Raises ValueError if it has no such waves.
    """
    cell = 2 * np.pi / size
    grid_spectrum = spectrum_between(
        spectrum, cell / np.sqrt(np.pi), pixels * cell / np.sqrt(np.pi)
    )
    if grid_spectrum is None:
        raise ValueError(f"expected waves between {size / pixels:g} and {size:g} nm, found none")
    return grid_spectrum


def predict_row(row):
    """Return the prediction of the closed form on the grid, and the coordinates of the surface."""
    grid_spectrum = spectrum_of_grid(spectrum_of(row), row["size"], row["pixels"])
    contact = Contact(  # 1e18 Pa is 1 N/nm².
        radius=row["radius"], rho=row["rho"], work=WORK, preload=row["area"], hardness=1e18
    )
    form = closed_form(grid_spectrum, contact)
    short, long = critical_band(grid_spectrum, contact, TOLERANCE)
    return {
        "predicted_force": form.force,
        "predicted_short_edge": short,
        "predicted_long_edge": long,
        **table_point(grid_spectrum, contact, form),
        "unfollowed_rms_height": form.rms_height,
        "apex_height": form.apex_height,
    }


def main():
    """Compute the rows that the table lacks, and write it after each; then predict all rows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--surfaces", type=int, default=0, help="of the design (160: all)")
    parser.add_argument("--table", type=Path, default=TABLE)
    arguments = parser.parse_args()
    rows = pd.read_csv(arguments.table).to_dict("records") if arguments.table.exists() else []
    done = {row["surface"] for row in rows}
    for row in design()[: arguments.surfaces]:
        if row["surface"] not in done:
            rows.append(row | compute_row(row))
            _write(rows, arguments.table)
    _write([row | predict_row(row) for row in rows], arguments.table)


def _write(rows, path):
    """Write the table, five digits a number."""
    pd.DataFrame(rows).to_csv(path, index=False, float_format="%.5g", lineterminator="\n")


if __name__ == "__main__":
    main()
