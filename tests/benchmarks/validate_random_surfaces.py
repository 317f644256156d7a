"""Forces that `hardcontact predict` gives on forty random surfaces, beside those on finer pixels.

    nice python tests/benchmarks/validate_random_surfaces.py [SURFACES]

Surfaces are of six families. The pixels of their scans are four times as wide, with the mean or one
of the heights of the finer pixels in each. Random are this choice, rms height, roll-off, Hurst
exponent, number, width and heights of features, radius and preload. Each row has the forces that
have an interval, relative to the mean force on the finer pixels at the same contacts. A scan
without reliable wavelengths is refused.
"""

import sys
import warnings
from functools import partial
from typing import NamedTuple

import numpy as np

import hardcontact as hc
from hardcontact.base.arrays import generator
from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.own.scan_contact import contact_on_scan
from hardcontact.own.wide_pixels import WIDE_PIXEL_WIDTH
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.levelling import level_plane
from hardcontact.surfaces.spectral_models import smooth_rolloff
from hardcontact.surfaces.synthesis import random_surface

FAMILIES = ("gaussian", "plateau", "pits", "peaks", "pillars", "steps")
#: Forces that `hardcontact predict` may print of a map.
FORCES = ("force_on_scan", "closed_form_on_scan", "closed_form_force", "extrapolated_force")
#: Pixels per row of the scans.
PIXELS = (128, 192, 256)


class Case(NamedTuple):
    """A surface on fine pixels, the levelled scan of it, and a contact."""

    fine: HeightMap
    scan: HeightMap
    contact: Contact


def random_case(family, seed, pixels):
    """Return a random case of a family; `pixels` are the scan's per row, all lengths in nm."""
    rng = generator(seed, family)
    fine_pixel = _draw_uniformly(rng, 8, 40) / WIDE_PIXEL_WIDTH
    rolloff = pixels * _draw_uniformly(rng, 1 / 20, 1 / 2)
    heights = _heights(family, rng, WIDE_PIXEL_WIDTH * pixels, WIDE_PIXEL_WIDTH * rolloff)
    heights *= _draw_uniformly(rng, 1, 50) / heights.std()
    fine = level_plane(HeightMap(heights, fine_pixel))
    blocks = fine.heights.reshape(pixels, WIDE_PIXEL_WIDTH, pixels, WIDE_PIXEL_WIDTH)
    coarse = blocks.mean(axis=(1, 3)) if rng.uniform() < 0.5 else blocks[:, 1, :, 1]
    contact = Contact(
        radius=_draw_uniformly(rng, 10e3, 150e3),
        rho=5.6,  # Range, work and hardness are the paper's.
        work=0.0463,
        preload=_draw_uniformly(rng, 1e-6, 30e-6),
        hardness=25e9,
        contacts_per_row=20,
    )
    return Case(fine, level_plane(HeightMap(coarse, WIDE_PIXEL_WIDTH * fine_pixel)), contact)


def _draw_uniformly(rng, low, high):
    """Return a random number, uniform in its logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _heights(family, rng, pixels, rolloff):
    """Return heights (y, x) of a family; the roll-off is in pixels."""
    waves = partial(_waves, rng, pixels, rng.uniform(0.5, 0.95))
    if family == "gaussian":
        return waves(rolloff)
    base = _draw_uniformly(rng, 0.02, 0.3) * waves(rolloff / 4)
    if family == "plateau":
        return base + np.minimum(waves(rolloff), rng.uniform(-0.5, 0.5))
    if family == "steps":
        return base + np.round(rng.uniform(0.5, 2) * waves(pixels))
    features = _features(rng, pixels, _draw_uniformly(rng, 0.1, 0.5) * rolloff, family == "pillars")
    return base - features if family == "pits" else base + features


def _waves(rng, pixels, hurst, rolloff):
    """Return Gaussian heights of unit rms, cut out of a surface of twice the size."""
    density = partial(smooth_rolloff, plateau=1.0, rolloff=rolloff, hurst=hurst)
    heights = random_surface(rng, 2 * pixels, 1.0, density).heights[:pixels, :pixels]
    return (heights - heights.mean()) / heights.std()


def _features(rng, pixels, width, are_flat):
    """Return the sum (y, x) of squares or Gaussian shapes of random heights at random positions."""
    count = round(_draw_uniformly(rng, 10, 200))
    distance = (np.arange(pixels) - rng.uniform(0, pixels, (2, count, 1))) / width
    shape_y, shape_x = np.abs(distance) < 1 if are_flat else np.exp(-(distance**2) / 2)
    return (rng.uniform(0.3, 1, count) * shape_y.T) @ shape_x


def true_force(case):
    """Return the mean plastic force (N) on the fine pixels, at the contacts on the scan."""
    contact = contact_on_scan(case.scan, case.contact)
    return contact.work * make_force_function(contact)(mirror_in_float32(case.fine)).mean()


def predicted_numbers(case):
    """Return the numbers that `hardcontact predict` has of the scan."""
    contact = case.contact
    return hc.predict(
        case.scan, radius=contact.radius, preload=contact.preload, hardness=contact.hardness,
        rho=contact.rho, work=contact.work,
    )  # fmt: skip


def forces_with_intervals(numbers):
    """Return the forces of a prediction that have an interval, by name."""
    forces = [numbers.get(name, Number(name, np.nan)) for name in FORCES]
    return {force.name: force for force in forces if np.isfinite(force.low + force.high)}


def main():
    """Print the table, and how many intervals exclude the force on the finer pixels."""
    warnings.simplefilter("ignore")
    excluded = total = 0
    for number in range(int(sys.argv[1]) if len(sys.argv) > 1 else 40):
        family, seed = FAMILIES[number % len(FAMILIES)], number // len(FAMILIES)
        case = random_case(family, seed, PIXELS[seed % len(PIXELS)])
        force = true_force(case)
        try:
            intervals = forces_with_intervals(predicted_numbers(case))
        except ValueError as error:
            print(f"{family} {seed}", f"refused: {error}", sep="\t")
            continue
        total += len(intervals)
        excluded += sum(not item.low <= force <= item.high for item in intervals.values())
        ratios = [
            f"{item.name} {np.divide([item.low, item.value, item.high], force).round(3)}"
            for item in intervals.values()
        ]
        print(f"{family} {seed}", *ratios, sep="\t", flush=True)
    print(f"{excluded} of {total} intervals exclude the force on the finer pixels")


if __name__ == "__main__":
    main()
