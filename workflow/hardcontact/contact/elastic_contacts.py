"""Elastic contacts of one pair of scans: pressure at the preload, and pull-off."""

from typing import NamedTuple, TypedDict

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hardcontact.contact import hertz
from hardcontact.contact.bearing_area import ContactSettings
from hardcontact.contact.elastic_solvers import adhesive_pull_off, contact_at_load
from hardcontact.contact.gap_map import gap_map, part_around_lowest
from hardcontact.contact.geometry import Bodies, sampled_contacts, window_pixels
from hardcontact.records.log import progress

__all__ = ["ElasticSettings", "Material", "elastic_contacts_of_pair"]

UNITS = {
    "contact_area": "nm2",
    "hard_share": "1",
    "peak_pressure": "Pa",
    "mean_pressure": "Pa",
    "rigid_pull_off_force": "N",
    "elastic_pull_off_force": "N",
    "iterations": "1",
}


class Material(TypedDict):
    """Young's modulus (Pa) and Poisson's ratio of a body."""

    modulus: float
    poisson_ratio: float


class ElasticSettings(TypedDict):
    """Materials, sample of contacts and window, as the configuration has them.

    Attributes
    ----------
    sphere, substrate : Material
        The two bodies.
    contacts : int
        Number of contacts in the sample.
    window : float
        Edge in nm of the part about the lowest gap that is solved for the pull-off.
    """

    sphere: Material
    substrate: Material
    contacts: int
    window: float


class _Solver(NamedTuple):
    """What all contacts of a pair are solved with; period and window in pixels."""

    bodies: Bodies
    contact: ContactSettings
    modulus: float
    rho: float
    work_of_adhesion: float
    period: int
    window: int

    def numbers(self, place: NDArray[np.int_]) -> tuple[dict[str, float], NDArray[np.float64]]:
        """Return the numbers of one contact, named as in UNITS, and the pressure at its peak."""
        gap, pixel_size = gap_map(self.bodies, place), self.bodies.geometry.pixel_size
        pressure, iterations = contact_at_load(
            part_around_lowest(gap, self.period), pixel_size, self.modulus, self.contact["preload"]
        )
        near = part_around_lowest(gap, self.window)
        pull_off = adhesive_pull_off(
            near, pixel_size, self.modulus, self.work_of_adhesion, self.rho
        )
        contact_pressure = pressure[pressure > 0]
        numbers = (
            contact_pressure.size * pixel_size**2,
            np.mean(contact_pressure > self.contact["hardness"]),
            contact_pressure.max(),
            contact_pressure.mean(),
            pull_off.rigid,
            pull_off.elastic,
            iterations + pull_off.iterations,
        )
        peak = -part_around_lowest(-pressure, min(64, self.period))
        return dict(zip(UNITS, numbers, strict=True)), peak

    def attributes(self) -> dict[str, float]:
        """Return what the contacts are solved with, in nm, N, Pa and J/m²."""
        geometry, preload = self.bodies.geometry, self.contact["preload"]
        return {
            "hardness": self.contact["hardness"],
            "preload": preload,
            "effective_modulus": self.modulus,
            "rho": self.rho,
            "work_of_adhesion": self.work_of_adhesion,
            "window": self.window * geometry.pixel_size,
            "sphere_radius": geometry.radius,
            "hertz_peak_pressure": hertz.contact(
                preload, geometry.radius, self.modulus
            ).peak_pressure,
        }


def _solver(
    bodies: Bodies,
    contact: ContactSettings,
    elastic: ElasticSettings,
    rho: float,
    work_of_adhesion: float,
) -> _Solver:
    """Return what all contacts of a pair of scans are solved with."""
    modulus = hertz.effective_modulus(
        elastic["sphere"]["modulus"],
        elastic["sphere"]["poisson_ratio"],
        elastic["substrate"]["modulus"],
        elastic["substrate"]["poisson_ratio"],
    )
    period = min(bodies.substrate.pixels, bodies.geometry.window)
    window = min(window_pixels(elastic["window"], bodies.geometry.pixel_size), period)
    return _Solver(bodies, contact, modulus, rho, work_of_adhesion, period, window)


def elastic_contacts_of_pair(
    bodies: Bodies,
    contact: ContactSettings,
    elastic: ElasticSettings,
    rho: float,
    work_of_adhesion: float,
    rng: np.random.Generator,
) -> xr.Dataset:
    """Return some contacts of a pair of scans, elastic instead of rigid or plastic.

    Parameters
    ----------
    bodies : Bodies
        With a rough sphere.
    contact : ContactSettings
        Array of contacts and load.
    elastic : ElasticSettings
        Materials, number of contacts and window.
    rho : float
        Range of adhesion in nm.
    work_of_adhesion : float
        In J/m².
    rng : numpy.random.Generator
        Draws the contacts.

    Returns
    -------
    xarray.Dataset
        The variables of UNITS by contact; of the first the pressure (y, x) about its peak.
    """
    solver = _solver(bodies, contact, elastic, rho, work_of_adhesion)
    places = sampled_contacts(rng, contact["count"], elastic["contacts"])
    # More threads wait for each other: twice the processor time for the same numbers.
    with threadpool_limits(1, "blas"):
        steps = progress(places, len(places), "elastic contacts")
        solved = [solver.numbers(place) for place in steps]
    pressure = solved[0][1]
    position = (np.arange(pressure.shape[0]) - pressure.shape[0] // 2) * bodies.geometry.pixel_size
    from_peak = {"units": "nm", "long_name": "position from the peak"}
    variables = {
        name: ("contact", [numbers[name] for numbers, _ in solved], {"units": unit})
        for name, unit in UNITS.items()
    }
    example = {"units": "Pa", "long_name": "pressure, one contact"}
    return xr.Dataset(
        variables | {"pressure": (("y", "x"), pressure, example)},
        {
            "contact_y": ("contact", places[:, 0]),
            "contact_x": ("contact", places[:, 1]),
            "y": ("y", position, from_peak),
            "x": ("x", position, from_peak),
        },
        solver.attributes(),
    )
