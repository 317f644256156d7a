"""A pool of small scans of UNCD's spectrum."""

from functools import cache

from measurements import uncd

from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.paper.pool import PoolInputs, compute_pool, pool_heights
from hardcontact.surfaces.conditioning import Targets
from hardcontact.surfaces.height_map import level
from hardcontact.surfaces.synthesis import ScanGrid, cut_scan, random_surface

GRID = ScanGrid(pixels=64, size=640.0, surface_pixels=128)
CONTACT = Contact(radius=250e3, preload=10e-6, hardness=25e9, window=1600.0, contacts_per_row=2)
TARGETS = Targets({"rms_height": 10.0}, 4.0, ())
HEIGHTS = pool_heights(TARGETS, 5, 7)
POOL_INPUTS = PoolInputs("uncd", uncd, TARGETS, HEIGHTS, GRID, CONTACT, [0.05, 1.0, 5.6], seed=7)


def raw_scan(number):
    """Return a scan of the pool as it is sampled."""
    rng = generator(7, "uncd", number, "pool")
    surface = random_surface(rng, GRID.surface_pixels, GRID.pixel_size, uncd)
    return level(cut_scan(surface, GRID.pixels))


@cache
def pool_of(*numbers):
    """Return the pool of some scans."""
    return compute_pool(numbers, POOL_INPUTS)
