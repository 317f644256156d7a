"""Forces that `hardcontact predict` has of forty random surfaces, against finer pixels.

    nice python tests/benchmarks/validate_random_surfaces.py [--seed 0] [--surfaces 40]

Each row is a scan of 128, 192 or 256 pixels per row of a surface with pixels four times finer,
see tests/helpers/random_surfaces.py. Forces and their intervals are relative to the mean force on
the finer pixels at the same contacts. A scan without reliable wavelengths is refused. The last line
counts the intervals without 1.
"""

import argparse
import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from random_surfaces import (
    FAMILIES,
    FORCES,
    forces_with_intervals,
    predicted_numbers,
    random_case,
    true_force,
)

PIXELS = (128, 192, 256)


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0, help="of the first surface of each family")
    parser.add_argument("--surfaces", type=int, default=40)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    print("surface", "pixel_nm", "rms_nm", "radius_um", "share_of_smooth", *FORCES, sep="\t")
    excluded = total = 0
    for number in range(arguments.surfaces):
        family, seed = FAMILIES[number % len(FAMILIES)], arguments.seed + number // len(FAMILIES)
        case = random_case(family, seed, PIXELS[seed % len(PIXELS)])
        force = true_force(case)
        try:
            numbers = predicted_numbers(case)
        except ValueError as error:
            print(f"{family} {seed}", f"refused: {error}", sep="\t")
            continue
        intervals = forces_with_intervals(numbers)
        total += len(intervals)
        excluded += sum(not item.low <= force <= item.high for item in intervals.values())
        lengths = case.scan.pixel_size, case.scan.heights.std(), case.contact.radius / 1e3
        share = force / numbers["smooth_force"].value
        cells = [_cell(numbers.get(name), force, name in intervals) for name in FORCES]
        print(
            f"{family} {seed}", *(f"{value:.3g}" for value in (*lengths, share)), *cells,
            sep="\t", flush=True,
        )  # fmt: skip
    print(f"{excluded} of {total} intervals exclude the force on the finer pixels")


def _cell(number, force, has_interval):
    """Return a predicted relative to the true force, with its interval and status."""
    if number is None:
        return ""
    interval = f" [{number.low / force:.3g}, {number.high / force:.3g}]" if has_interval else ""
    return f"{number.value / force:.3g}{interval} {number.status}"


if __name__ == "__main__":
    main()
