"""Which scans of own surfaces contacts are made on: the choice of a size."""

import math
from collections.abc import Sequence

from hardcontact.answer.quantities import print_length
from hardcontact.study.grid_limits import MAP_PIXELS
from hardcontact.study.grids import PIXEL_SIZES
from hardcontact.study.inventory import Entry

__all__ = ["contact_scans"]

#: Pixels that the interaction radius sqrt(2 R rho) spans on a scan that resolves it well.
RESOLVED = 32
#: The size of a scan over sqrt(2 R sigma), within which the sphere finds its highest points. On
#: Gaussian surfaces with the spectra of UNCD, MCD and polished UNCD the mean force on mirrored
#: scans of twice that is at most a third too large.
SIZE_OVER_REACH = 2.0

#: Scans of one surface on the same pixels.
Group = list[Entry]


def contact_scans(
    entries: Sequence[Entry], sphere: str | None, radius: float, rho: float
) -> tuple[list[Entry], list[str]]:
    """Return the scans that contacts are made on, of every surface those on one grid.

    Surfaces are compared on one grid where they have one in common. Of grids that resolve the
    interaction radius, it is the smallest from which the sphere finds its highest points, or else
    the largest.

    Parameters
    ----------
    entries : sequence of Entry
        Of all surfaces.
    sphere : str or None
        Id of the sphere's surface; None if it is smooth.
    radius : float
        Of the sphere, in nm.
    rho : float
        Range of adhesion in nm.

    Returns
    -------
    chosen : list of Entry
        Height maps.
    reasons : list of str
        In words, one a surface or one for all.

    Raises
    ------
    ValueError
        In one line a surface without a height map.
    """
    groups = _groups_by_surface(entries)
    substrates = {name: of_it for name, of_it in groups.items() if name != sphere}
    if common := _common(substrates):
        substrates = common
    chosen: list[Entry] = []
    reasons = []
    for surface, of_it in substrates.items():
        together = [group for groups in substrates.values() for group in groups]
        roughest = max(_rms(group) for group in (together if common else of_it))
        group = _best(of_it, radius, rho, roughest)
        chosen += group
        reasons.append(_reason(surface, group, of_it, radius, roughest))
    if sphere is not None:
        group = _of_sphere(groups[sphere], chosen, radius)
        chosen += group
        reasons.append(f"{sphere}: {_named(group)}, subtracted from which is the sphere's shape")
    return chosen, reasons


def _groups_by_surface(entries: Sequence[Entry]) -> dict[str, list[Group]]:
    """Return the height maps of each surface, those on the same pixels together."""
    groups: dict[str, list[Group]] = {}
    least, most = PIXEL_SIZES
    for entry in entries:
        of_it = groups.setdefault(entry.source.surface, [])
        if entry.kind != "map" or not least <= entry.pixel_size <= most:
            continue
        same = next((group for group in of_it if _alike(group[0], entry)), None)
        if same is None:
            of_it.append([entry])
        else:
            same.append(entry)
    if without := [surface for surface, of_it in groups.items() if not of_it]:
        raise ValueError(
            "\n".join(
                f"surface {surface}: expected a height map, on which contacts are made, with "
                f"pixels of {least:g} to {most:g} nm, found none"
                for surface in without
            )
        )
    return groups


def _alike(first: Entry, second: Entry) -> bool:
    """Return whether two maps have the same pixels, as the checks of the study see it."""
    same_size = math.isclose(second.pixel_size, first.pixel_size, rel_tol=1e-3)
    return first.pixels == second.pixels and same_size


def _common(groups: dict[str, list[Group]]) -> dict[str, list[Group]]:
    """Return the groups whose pixels all surfaces have, if there are some and two surfaces."""
    if len(groups) < 2:
        return {}
    common = {
        surface: [
            group
            for group in of_it
            if all(
                any(_alike(other[0], group[0]) for other in others) for others in groups.values()
            )
        ]
        for surface, of_it in groups.items()
    }
    return common if all(common.values()) else {}


def _rms(group: Group) -> float:
    """Return the largest rms height of a group in nm."""
    return max(entry.rms_height for entry in group)


def _best(groups: list[Group], radius: float, rho: float, rms_height: float) -> Group:
    """Return the group that contacts are made on, of one surface."""
    interaction = math.sqrt(2 * radius * rho)
    enough = SIZE_OVER_REACH * math.sqrt(2 * radius * rms_height)

    def rank(group: Group) -> tuple[bool, bool, bool, float, int, float]:
        size, pixel_size, count = group[0].size, group[0].pixel_size, len(group)
        blind = all(entry.band.shortest > entry.band.longest for entry in group)
        if interaction < RESOLVED * pixel_size:  # Then the finest pixels.
            return blind, True, False, pixel_size, -count, -size
        small = size < enough
        return blind, False, small, -size if small else size, -count, pixel_size

    return min(groups, key=rank)


def _reason(
    surface: str, group: Group, groups: list[Group], radius: float, rms_height: float
) -> str:
    """Return why contacts on a surface are made on these scans, in words."""
    if len(groups) == 1:
        return f"{surface}: {_named(group)}: no others can be used"
    enough = SIZE_OVER_REACH * math.sqrt(2 * radius * rms_height)
    if group[0].size >= enough:
        why = f"the smallest of at least {print_length(enough)}, twice sqrt(2 R sigma)"
    else:
        why = f"they come nearest to {print_length(enough)}, twice sqrt(2 R sigma)"
    return f"{surface}: {_named(group)}: {why}"


def _named(group: Group) -> str:
    scans = "the scan" if len(group) == 1 else f"the {len(group)} scans"
    return f"{scans} of {print_length(group[0].size)} and {group[0].pixels} pixels"


def _of_sphere(groups: list[Group], substrates: Sequence[Entry], radius: float) -> Group:
    """Return the scans of the sphere: on the pixels of the substrates, or else the most.

    Pairs are computed on the finer pixels of both, so that sizes too different make large maps.
    """

    def rank(group: Group) -> tuple[bool, bool, int, float]:
        first = group[0]
        large = any(
            2 * max(first.size, other.size) / min(first.pixel_size, other.pixel_size) > MAP_PIXELS
            for other in substrates
        )
        alike = all(_alike(first, other) for other in substrates)
        return large or first.size > radius, not alike, -len(group), -first.size

    return min(groups, key=rank)
