"""Small studies that sets are sampled from, with pools and masters of random numbers."""

import numpy as np
import pandas as pd
import xarray as xr
from known_masters import master_ratios
from paper_numbers import MEAN_FORCE, SUBSTRATES, SURFACES, TABLE1

from hardcontact.paper.sets import SetInputs
from hardcontact.surfaces.metrics import METRICS
from hardcontact.surfaces.topography import scan_averages

CONFIDENCE, SCANS, CONTACTS = 0.95, 5, 3
RADIUS, RHO, MODELS = 250e3, [0.05, 2.0, 4.0, 5.6, 8.0], ["rigid", "plastic"]
CUTOFFS = {"short": [20.0, 43.0, 120.0], "long": [500.0, 1800.0, 3500.0]}
AXES = ("contact_model", "rho", "contact_y", "contact_x")
HEIGHTS = dict(zip(SUBSTRATES, TABLE1["afm_rms_height"][0], strict=True))


def scans(rng, heights):
    """Return METRICS (scan) of scans of these rms heights in nm."""
    return {
        name: ("scan", heights * rng.uniform(0.5, 1.5), {"units": unit})
        for name, (unit, _) in METRICS.items()
    } | {"rms_height": ("scan", heights, {"units": "nm"})}


def make_pool(surface, count=12):
    """Return a pool whose forces fall with the height, near those of the paper."""
    rng = np.random.default_rng(SUBSTRATES.index(surface))
    mean = HEIGHTS[surface]
    force_heights = mean * np.linspace(0.3, 1.8, 5)
    force = MEAN_FORCE[SUBSTRATES.index(surface)] / 0.0463
    log_force = (
        np.log(force * np.array([0.5, 1.0])[:, None] * (np.array(RHO) / 5.6) ** 0.5)[
            :, :, None, None
        ]
        - (force_heights / mean - 1)[:, None, None, None, None]
        + rng.normal(0, 0.5, (count, 1, 1, 1, CONTACTS, CONTACTS))
    )
    return xr.Dataset(
        scans(rng, mean * rng.uniform(0.8, 1.2, count))
        | {"log_force": (("scan", "rms_height_of_force", *AXES), log_force)},
        {
            "scan": range(1, count + 1),
            "rms_height_of_force": force_heights,
            "contact_model": MODELS,
            "rho": RHO,
            "contact_y": range(CONTACTS),
            "contact_x": range(CONTACTS),
        },
        {"mean_rms_height": mean, "rms_height_deviation": 0.2 * mean},
    )


def make_topography(measured_surfaces=()):
    """Return the roughness of SCANS scans of each surface."""
    rng = np.random.default_rng(10)
    surfaces_scans = [
        xr.Dataset(scans(rng, HEIGHTS.get(name, 0.5) * np.linspace(0.9, 1.1, SCANS)))
        for name in SURFACES
    ]
    scan_table = xr.concat(surfaces_scans, pd.Index(SURFACES, name="surface"))
    scan_table = scan_table.assign_coords(scan=range(1, SCANS + 1))
    source = ["measured" if name in measured_surfaces else "substitute" for name in SURFACES]
    descriptions = {"label": SURFACES, "source": source, "table1_rows_met": [""] * len(SURFACES)}
    return (
        xr.merge([scan_table, scan_averages(scan_table, CONFIDENCE)])
        .assign({f"all_scales_{name}": ("surface", np.ones(len(SURFACES))) for name in METRICS})
        .assign({name: ("surface", values) for name, values in descriptions.items()})
        .assign_attrs(confidence=CONFIDENCE, sphere_surface="ruby")
    )


def make_adhesion():
    """Return forces on two scans of the sphere, with more contacts than in the pools."""
    rng = np.random.default_rng(11)
    force = MEAN_FORCE[:, None, None] * np.array([0.5, 1.0])[:, None] * (np.array(RHO) / 5.6) ** 0.5
    spread = rng.normal(0, 0.5, (4, SCANS, 2, 1, 1, 4, 4))
    forces = force[:, None, None, :, :, None, None] / 0.0463 * np.exp(spread)
    return xr.Dataset(
        {
            "pull_off_force": (("surface", "scan", "sphere_scan", *AXES), forces, {"units": "N"}),
            "contact_pixel_count": ("contact_model", [1, 17]),
            "label": ("surface", SUBSTRATES),
            "source": ("surface", ["substitute"] * 4),
        },
        {
            "surface": SUBSTRATES,
            "scan": range(1, SCANS + 1),
            "sphere_scan": [1, 2],
            "contact_model": MODELS,
            "rho": RHO,
            "contact_y": range(4),
            "contact_x": range(4),
        },
        {"rho": 5.6, "sphere_radius": RADIUS, "pixel_size": 5.0, "work_of_adhesion": 1.0},
    )


def make_masters(realizations=6):
    """Return ratios whose distance from one is as the cutoff, or as its inverse if long."""
    rng = np.random.default_rng(12)
    cutoffs = np.array([*CUTOFFS["short"], *CUTOFFS["long"]])
    slope = rng.uniform(0.5, 1.5, (4, realizations, 1))
    ratio = np.full((4, realizations, 2, len(cutoffs)), np.nan)
    ratio[:, :, 0, :3] = 1 + 0.1 * slope * cutoffs[:3] / 43
    ratio[:, :, 1, 3:] = 1 - 0.1 * slope * 1800 / cutoffs[3:]
    return master_ratios(ratio, cutoffs, SUBSTRATES, 2.44)


def make_inputs(measured_surfaces=()):
    """Return inputs of sets; measured surfaces have no pool."""
    factor = xr.DataArray(
        np.full((2, 4, len(RHO)), [[[0.9]], [[0.95]]]),
        {"contact_model": MODELS, "surface": SUBSTRATES, "rho": RHO},
        ("contact_model", "surface", "rho"),
    )
    pools = {name: make_pool(name) for name in SUBSTRATES if name not in measured_surfaces}
    return SetInputs(
        make_topography(measured_surfaces), make_adhesion(), pools, {}, factor, make_masters()
    )
