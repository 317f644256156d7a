"""Checks of the arguments of functions and commands, with the limits of a study."""

import math
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from hardcontact.base.units import format_exact, parse_quantity
from hardcontact.config.configuration import CONTACT_QUANTITIES, quantity_type
from hardcontact.config.faults import raise_faults, shorten
from hardcontact.config.keys import NONE
from hardcontact.config.limits import PIXEL_SIZES, NamedContact, contact_faults
from hardcontact.contact.contact import Contact
from hardcontact.contact.hertz_jkr_dmt import STRONGEST_WORK
from hardcontact.contact.numerical_limits import Extent
from hardcontact.scans.reading import MASKS
from hardcontact.surfaces.height_map import HeightMap, mirror_scan
from hardcontact.surfaces.synthesis import SIDES

#: The usual bounds of CONTACT_QUANTITIES, and examples of what lies between. Sources: spheres and
#: loads of microscopes, lenses of the surface forces apparatus: Butt et al., Surf. Sci. Rep. 59
#: (2005) 1; diamond: Brazhkin et al., Phil. Mag. A 82 (2002) 231; long ranges: DelRio et al.,
#: Nature Mater. 4 (2005) 629; works of adhesion: Israelachvili, Intermolecular and Surface Forces
#: (2011).
USUAL_BOUNDS = {
    "radius": ("1 um", "50 mm", "spheres in pull-off tests, from colloidal probes to lenses"),
    "hardness": ("100 MPa", "150 GPa", "solids that yield, from plastics to diamond"),
    "preload": ("100 pN", "1 mN", "loads of microscopes and of microtesters"),
    "range": ("0.2 nm", "40 nm", "ranges from atomic bonds to long dispersion forces"),
    "work": ("0.1 mJ/m2", f"{STRONGEST_WORK:g} J/m2", "solids, up to diamond on itself"),
}
#: A remedy in messages on files: a key with its value, perhaps after an option with this value,
#: such as "--unit nm (scan.unit: nm)". Its number is a length in nm.
REMEDY = re.compile(r"(?:--\w+ \S+ \()?scan\.(\w+): ([\w,]+)\)?")


@contextmanager
def arguments_in_messages() -> Iterator[None]:
    """Put arguments of functions in place of options and keys in a ValueError of the block."""
    try:
        yield
    except ValueError as error:
        raise ValueError(REMEDY.sub(_format_argument, str(error))) from None


def _format_argument(remedy: re.Match[str]) -> str:
    """Return a remedy as the argument of a function."""
    name, value = remedy.groups()
    return f"{name}={value.removesuffix('nm')}" if value[0].isdigit() else f'{name}="{value}"'


def unit_question(quantity: str, number: float) -> str:
    """Return a question if a number, in the unit of its key, is not usual, or else no text."""
    *bounds, examples = USUAL_BOUNDS[quantity]
    unit = quantity_type(CONTACT_QUANTITIES[quantity][0]).unit
    low, high = (parse_quantity(bound, unit) for bound in bounds)
    if low <= number <= high:
        return ""
    prefixed = [number * factor for factor in (1e-3, 1e3, 1e-6, 1e6)]  # with another prefix
    meant = [format_exact(candidate, unit) for candidate in prefixed if low <= candidate <= high]
    suggestion = f" (did you mean {meant[0]}?)" if meant else ""
    return f"is the unit right? {' to '.join(bounds)} are usual for {examples}{suggestion}"


#: Texts of which only some are accepted.
CHOICES = {"mask": MASKS, "undefined_pixels": ("refuse", "harmonic")}


def check_read_arguments(
    files: Sequence[object], lengths: Mapping[str, object], **texts: object
) -> None:
    """Refuse faulty arguments of functions that read files.

    Files must be paths, `texts` must be texts, some of them one of CHOICES. `lengths` must be
    positive numbers, unless they are None or "none".
    """
    faults = [
        f"files: expected a path in each argument, found {' '.join(shorten(file).split())}"
        for file in files
        if not isinstance(file, str | Path)
    ]
    faults += [
        f"{name}: expected a text, found {shorten(text)}"
        for name, text in texts.items()
        if not isinstance(text, str)
    ]
    faults += [
        f"{name}: expected {' or '.join(choices)}, found {shorten(texts[name])}"
        for name, choices in CHOICES.items()
        if name in texts and texts[name] not in choices
    ]
    raise_faults(faults)
    check_positive(**{name: value for name, value in lengths.items() if value not in (None, NONE)})


def check_positive_numbers(name: str, numbers: Any) -> None:
    """Refuse an argument that is not a sequence of positive numbers."""
    is_sequence = isinstance(numbers, Sequence | np.ndarray) and not isinstance(numbers, str)
    if not (is_sequence and len(numbers)):
        raise ValueError(f"{name}: expected several numbers, found {shorten(numbers)}")
    for number in numbers:
        check_positive(**{name: number})


def check_positive(**numbers: object) -> None:
    """Refuse numbers that are not positive and finite."""
    raise_faults(
        f"{name}: expected a positive number, found {value!r}"
        for name, value in numbers.items()
        if not (isinstance(value, int | float | np.number) and 0 < value < math.inf)
    )


def check_tolerance(tolerance: float) -> None:
    """Refuse a tolerance that is no share: a change by more than all of the force."""
    check_positive(tolerance=tolerance)
    if tolerance >= 1:
        raise ValueError(f"tolerance: expected less than 1, found {tolerance:g}")


def check_quantities(**numbers: Any) -> None:
    """Refuse quantities of a contact beyond the limits of their keys, and warn of unusual ones."""
    check_positive(**numbers)
    options = {name: "range" if name == "rho" else name for name in numbers}
    types = {name: quantity_type(CONTACT_QUANTITIES[options[name]][0]) for name in numbers}
    written = {name: f"{numbers[name]:g} {quantity.unit}" for name, quantity in types.items()}
    raise_faults(
        f"{name}: expected {quantity.expects}, found {written[name]}: is the unit right?"
        for name, quantity in types.items()
        if not quantity.low <= numbers[name] <= quantity.high
    )
    for name, option in options.items():
        if question := unit_question(option, numbers[name]):
            warnings.warn(f"{name} {written[name]}: {question}", stacklevel=3)


def check_contact(height_map: HeightMap, contact: Contact, ranges: Sequence[float]) -> None:
    """Refuse pixels, a window, contacts per row, a load or ranges beyond the limits of a study."""
    low, high = PIXEL_SIZES
    if not low <= height_map.pixel_size <= high:
        raise ValueError(
            f"scan: expected a pixel_size of {low:g} to {high:g} nm, found "
            f"{height_map.pixel_size:g} nm: is the unit right?"
        )
    count = contact.contacts_per_row
    check_positive(window=contact.window, contacts_per_row=count)
    if count != int(count):
        raise ValueError(f"contacts_per_row: expected a whole number, found {count:g}")
    # Limits are stated for a scan, which is half as large as its periodic map.
    relief = float(np.ptp(height_map.heights))
    extent = Extent(height_map.pixels // 2, height_map.pixel_size, height_map.size / 2, relief)
    contact = replace(contact, rho=min(ranges))
    named_contact = NamedContact(contact, "preload", "contacts_per_row", "rho")
    raise_faults(islice(contact_faults(named_contact, "the map", extent), 1))


def check_cutoffs(cutoffs: Mapping[str, Sequence[float]], height_map: HeightMap) -> None:
    """Refuse cutoffs that are no sequences by side, or at which a periodic surface has no waves."""
    if not isinstance(cutoffs, Mapping) or not cutoffs or not set(cutoffs) <= set(SIDES):
        raise ValueError(
            f"cutoffs: expected a mapping with short, long or both, found {shorten(cutoffs)}"
        )
    for side_cutoffs in cutoffs.values():
        check_positive_numbers("cutoffs", side_cutoffs)
    shortest, longest = 2 * height_map.pixel_size * (1 + 1e-9), height_map.size
    raise_faults(
        f"cutoffs: expected wavelengths of more than two pixels ({shortest:.4g} nm) and at most "
        f"the {longest:.6g} nm of the mirrored scan on the {side} side, found {[*side_cutoffs]}"
        for side, side_cutoffs in cutoffs.items()
        if not shortest < min(side_cutoffs) <= max(side_cutoffs) <= longest
    )


def make_periodic(height_map: HeightMap, name: str = "scan") -> HeightMap:
    """Return a map as it is if it is periodic, mirrored otherwise; refuse an invalid map."""
    if not isinstance(height_map, HeightMap):
        raise ValueError(
            f"{name}: expected a scan of hc.read_scan(FILE), or hc.HeightMap(heights, pixel_size) "
            f"in nm, found {type(height_map).__name__}"
        )
    check_heights(height_map.heights, name)
    return height_map if height_map.periodic else mirror_scan(height_map)


def check_heights(heights: np.ndarray, name: str) -> None:
    """Refuse heights that are not a square array of finite numbers."""
    if not isinstance(heights, np.ndarray):
        description = type(heights).__name__
    elif heights.ndim != 2 or len(set(heights.shape)) > 1:
        description = " x ".join(map(str, heights.shape)) + " pixels"
    elif not np.isfinite(heights).all():
        description = f"{np.count_nonzero(~np.isfinite(heights))} undefined heights"
    else:
        return
    raise ValueError(f"{name}: expected a square map of finite heights, found {description}")
