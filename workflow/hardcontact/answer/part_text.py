"""What the sentences of a part are made of: numbers with intervals, lists of names."""

from collections.abc import Iterable, Sequence

import xarray as xr

from hardcontact.numbers.printing import DIGITS, print_bounded_as_paper
from hardcontact.numbers.statistics import bounds
from hardcontact.surfaces.synthesis import SIDES

#: Of ratios that are near one.
NEAR_ONE = 3

#: The edge of the band at each side.
EDGE_NAMES = dict(zip(SIDES, ("short", "long"), strict=True))


def print_each(dataset: xr.Dataset, name: str, digits: int = DIGITS) -> str:
    """Return a number (surface,) with its interval for every surface of a dataset by label."""
    return "; ".join(
        f"{of_surface['label'].item()} {print_bounded_as_paper(of_surface, name, '1', digits)}"
        for of_surface in (dataset.sel(surface=one) for one in dataset["surface"].values)
    )


def differs_from_one(ratios: xr.Dataset, name: str) -> xr.DataArray:
    """Return where the interval of a ratio lies above or below one; false without an interval."""
    low, high = bounds(ratios, name)
    return (low > 1) | (high < 1)


def listed(items: Iterable[str]) -> str:
    """Return items as "a, b and c"."""
    *others, last = items
    return f"{', '.join(others)} and {last}" if others else last


def labels(dataset: xr.Dataset, surfaces: Sequence[str]) -> str:
    """Return the labels of some surfaces of a dataset with `label(surface)`, as a list."""
    return listed(str(dataset["label"].sel(surface=surface).item()) for surface in surfaces)
