"""Inputs of small sets: forces near those of the paper, which fall with the rms height."""

import numpy as np
import pandas as pd
import xarray as xr
from known_masters import master_ratios
from paper_numbers import MEAN_FORCE, RADIUS, SUBSTRATES, SURFACES, TABLE1, WORK

from hardcontact.paper.sets import SetInputs
from hardcontact.surfaces.metrics import METRICS
from hardcontact.surfaces.topography import scan_averages

CONFIDENCE = 0.95
#: Scans of each surface, and contacts per row on a scan of a pool.
SCANS, CONTACTS = 5, 3
RHO, MODELS = [0.05, 2.0, 4.0, 5.6, 8.0], ["rigid", "plastic"]
#: Forces on the rough sphere relative to a smooth one, by MODELS.
SPHERE_FACTORS = [0.9, 0.95]
CUTOFFS = np.array([20.0, 43.0, 120.0, 500.0, 1800.0, 3500.0])
AXES = ("contact_model", "rho", "contact_y", "contact_x")
HEIGHTS = dict(zip(SUBSTRATES, TABLE1["afm_rms_height"][0], strict=True))
#: Forces (contact_model, rho) relative to that of plastic contact at 5.6 nm.
CURVES = np.outer([0.5, 1.0], (np.array(RHO) / 5.6) ** 0.5)


def contact_coordinates(contacts):
    """Return the coordinates of forces with a number of contacts per row."""
    numbers = range(contacts)
    return {"contact_model": MODELS, "rho": RHO, "contact_y": numbers, "contact_x": numbers}


def scan_metrics(rng, heights):
    """Return METRICS (scan) of scans of these rms heights in nm."""
    return {
        name: ("scan", heights * rng.uniform(0.5, 1.5), {"units": unit})
        for name, (unit, _) in METRICS.items()
    } | {"rms_height": ("scan", heights, {"units": "nm"})}


def make_pool(surface):
    """Return a pool whose forces fall with the height, near those of the paper."""
    rng = np.random.default_rng(SUBSTRATES.index(surface))
    mean = HEIGHTS[surface]
    force_heights = mean * np.linspace(0.3, 1.8, 5)
    force = MEAN_FORCE[SUBSTRATES.index(surface)] / WORK
    log_force = (
        np.log(force * CURVES)[:, :, None, None]
        - (force_heights / mean - 1)[:, None, None, None, None]
        + rng.normal(0, 0.5, (12, 1, 1, 1, CONTACTS, CONTACTS))
    )
    return xr.Dataset(
        scan_metrics(rng, mean * rng.uniform(0.8, 1.2, 12))
        | {"log_force": (("scan", "rms_height_of_force", *AXES), log_force)},
        {"scan": range(1, 13), "rms_height_of_force": force_heights}
        | contact_coordinates(CONTACTS),
        {"mean_rms_height": mean, "rms_height_deviation": 0.2 * mean},
    )


def make_topography(measured_surfaces=()):
    """Return the roughness of SCANS scans of each surface, 0.5 nm on the ruby."""
    rng = np.random.default_rng(10)
    surface_metrics = [
        xr.Dataset(scan_metrics(rng, HEIGHTS.get(name, 0.5) * np.linspace(0.9, 1.1, SCANS)))
        for name in SURFACES
    ]
    scans = xr.concat(surface_metrics, pd.Index(SURFACES, name="surface"))
    scans = scans.assign_coords(scan=range(1, SCANS + 1))
    source = ["measured" if name in measured_surfaces else "substitute" for name in SURFACES]
    descriptions = {"label": SURFACES, "source": source, "table1_rows_met": [""] * len(SURFACES)}
    return (
        xr.merge([scans, scan_averages(scans, CONFIDENCE)])
        .assign({f"all_scales_{name}": ("surface", np.ones(len(SURFACES))) for name in METRICS})
        .assign({name: ("surface", values) for name, values in descriptions.items()})
        .assign_attrs(confidence=CONFIDENCE, sphere_surface="ruby")
    )


def make_adhesion():
    """Return forces on two scans of the sphere, with more contacts than in the pools."""
    rng = np.random.default_rng(11)
    force = MEAN_FORCE[:, None, None] * CURVES
    scatter = rng.normal(0, 0.5, (4, SCANS, 2, 1, 1, 4, 4))
    forces = force[:, None, None, :, :, None, None] / WORK * np.exp(scatter)
    return xr.Dataset(
        {
            "pull_off_force": (("surface", "scan", "sphere_scan", *AXES), forces, {"units": "N"}),
            "contact_pixel_count": ("contact_model", [1, 17]),
            "label": ("surface", SUBSTRATES),
            "source": ("surface", ["substitute"] * 4),
        },
        {"surface": SUBSTRATES, "scan": range(1, SCANS + 1), "sphere_scan": [1, 2]}
        | contact_coordinates(4),
        {"rho": 5.6, "sphere_radius": RADIUS, "pixel_size": 5.0, "work_of_adhesion": 1.0},
    )


def make_masters():
    """Return ratios that on average differ from one by 10 % at 43 nm and at 1.8 µm."""
    rng = np.random.default_rng(12)
    slope = rng.uniform(0.5, 1.5, (4, 6, 1))
    ratio = np.full((4, 6, 2, len(CUTOFFS)), np.nan)
    ratio[:, :, 0, :3] = 1 + 0.1 * slope * CUTOFFS[:3] / 43
    ratio[:, :, 1, 3:] = 1 - 0.1 * slope * 1800 / CUTOFFS[3:]
    return master_ratios(ratio, CUTOFFS, SUBSTRATES, shortest=2.44)


def make_inputs(measured_surfaces=()):
    """Return inputs of sets; measured surfaces have no pool."""
    factor = xr.DataArray(
        np.broadcast_to(np.reshape(SPHERE_FACTORS, (2, 1, 1)), (2, 4, len(RHO))),
        {"contact_model": MODELS, "surface": SUBSTRATES, "rho": RHO},
        ("contact_model", "surface", "rho"),
    )
    pools = {name: make_pool(name) for name in SUBSTRATES if name not in measured_surfaces}
    return SetInputs(
        make_topography(measured_surfaces), make_adhesion(), pools, {}, factor, make_masters()
    )
