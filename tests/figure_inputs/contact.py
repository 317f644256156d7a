"""Datasets of contacts: one contact, indents, elastic contacts, patches that carry the force."""

import numpy as np
import xarray as xr
from paper_numbers import SUBSTRATES

from figure_inputs.building import RADIUS, SCANS, SPHERE_SCANS, generator, named

HARDNESS = 25e9
CONTACTS = 4
PRELOADS = [1e-5, 2e-5]
PIXEL, PIXELS = 4.9, 65


def contact() -> xr.Dataset:
    """Return one contact of a sphere on a wavy surface."""
    x = np.linspace(-6250, 6250, 101)
    hills = 12 * np.sin(x / 150)[:, None] * np.sin(x / 190) + 12
    gap = (x[:, None] ** 2 + x**2) / (2 * RADIUS) + hills
    separation = np.linspace(0, 30, 61)
    return xr.Dataset(
        {
            "adhesive_pressure": (("y", "x"), 0.0447 / 5.2e-9 * np.exp(-gap / 5.2)),
            "force": ("separation", -5e-7 * np.exp(-separation / 5.2)),
        },
        coords={"separation": separation, "y": x, "x": x},
        attrs={"surface": "uncd", "label": "UNCD", "basis": "substitute"},
    )


def indent() -> xr.Dataset:
    """Return indents of one contact, and sizes of those of all."""
    rng = generator()
    place = (np.arange(PIXELS) - PIXELS // 2) * PIXEL
    pit = np.clip(1 - (place[:, None] / 12) ** 2 - ((place - 4 * PIXEL) / 22) ** 2, 0, None)
    dims = ("preload", "scan", "sphere_scan", "contact_y", "contact_x")
    shape = (len(PRELOADS), SCANS, SPHERE_SCANS, CONTACTS, CONTACTS)
    growth = np.reshape([1.0, 1.4], (-1, 1, 1, 1, 1))
    return xr.Dataset(
        {
            "depth": (dims, rng.uniform(1, 3, shape[1:]) * growth),
            "edge_length": (dims, PIXEL * np.sqrt(rng.integers(6, 17, shape[1:]) * growth**2)),
            "lateral_size": (dims, PIXEL * rng.integers(4, 9, shape).astype(float)),
            "indentation": (("preload", "y", "x"), np.stack([pit, 2.7 * pit])),
            "sphere_height": (
                ("y", "x"),
                (place[:, None] ** 2 + (place + 900) ** 2) / (2 * RADIUS),
            ),
        },
        coords={"preload": PRELOADS, "y": place, "x": place},
        attrs={"surface": "ncd", "label": "NCD", "basis": "substitute"},
    )


def elastic() -> xr.Dataset:
    """Return elastic contacts whose pull-off forces differ little from the rigid ones."""
    rng = generator()
    dims, shape = ("surface", "scan", "contact"), (len(SUBSTRATES), SCANS, CONTACTS)
    rigid = rng.lognormal(-16, 0.5, shape)
    place = (np.arange(64) - 32) * PIXEL
    hill = 1 - (place[:, None] ** 2 + place**2) / 60**2
    height = np.reshape([20, 60, 90, 120], (-1, 1, 1)) * 1e9
    return (
        named()
        .assign(
            hard_share=(dims, rng.uniform(0.2, 0.9, shape)),
            peak_pressure=(dims, rng.lognormal(25, 0.5, shape)),
            rigid_pull_off_force=(dims, rigid),
            elastic_pull_off_force=(dims, rigid * (1 - rng.uniform(0, 1e-3, shape))),
            pressure=(("surface", "y", "x"), height * np.sqrt(np.clip(hill, 0, None))),
        )
        .assign_coords(scan=np.arange(1, SCANS + 1), y=place, x=place)
        .assign_attrs(hardness=HARDNESS, hertz_peak_pressure=137e6)
    )


def asperities() -> xr.Dataset:
    """Return patches of random size and extent."""
    rng = generator()
    rho = np.array([0.5, 1.0, 2.0, 5.6, 10.0])
    dims = ("surface", "rho", "scan", "contact")
    shape = (len(SUBSTRATES), len(rho), SCANS, CONTACTS)
    largest = rng.uniform(0.2, 0.6, shape)
    return (
        named()
        .assign_coords(rho=rho)
        .assign(
            largest_share=(dims, largest),
            two_largest_share=(dims, largest + rng.uniform(0, 0.3, shape)),
            patches=(dims, rng.integers(2, 200, shape).astype(float)),
            extent=(dims, 1500 * np.sqrt(rho)[:, None, None] * rng.uniform(0.3, 1, shape)),
        )
        .assign_attrs(share=0.9, sphere_radius=RADIUS)
    )
