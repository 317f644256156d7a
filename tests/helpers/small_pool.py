"""A pool of small scans of UNCD's spectrum."""

from functools import cache

import pandas as pd
from measurements import UNCD, cut_scan

from hardcontact.base.arrays import generator
from hardcontact.contact.contact import Contact
from hardcontact.paper.pool import compute_pool, pool_rms_heights
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectrum import spectrum_dataset
from hardcontact.surfaces.substitutes import Substitute
from hardcontact.surfaces.synthesis import ScanGrid, random_surface

GRID = ScanGrid(pixels=64, size=640.0, surface_pixels=128)
CONTACT = Contact(radius=250e3, preload=10e-6, hardness=25e9, window=1600.0, contacts_per_row=2)
SUBSTITUTE = Substitute(
    "uncd",
    spectrum_dataset(UNCD.density).assign_attrs(
        expected_scan_rms=[10.0, 0.4, 0.05], table1_rows_met=""
    ),
    pd.DataFrame({"value": 10.0, "uncertainty": 4.0}, index=["afm_rms_height"]),
    pd.DataFrame({"value": {"scan_pixels": GRID.pixels, "scan_size": GRID.size}}),
    GRID,
    seed=7,
)
HEIGHTS = pool_rms_heights(SUBSTITUTE.targets, scan_count=5, height_count=7)
RANGES = [0.05, 1.0, 5.6]  # nm


def raw_scan(number):
    """Return a levelled scan of the pool before its rms height is scaled."""
    rng = generator(SUBSTITUTE.seed, "uncd", number, "pool")
    surface = random_surface(rng, GRID.surface_pixels, GRID.pixel_size, UNCD)
    return level_plane(cut_scan(surface, GRID.pixels))


@cache
def pool_of(*numbers):
    """Return the pool of scans with these numbers."""
    return compute_pool(numbers, SUBSTITUTE, HEIGHTS, CONTACT, RANGES)
