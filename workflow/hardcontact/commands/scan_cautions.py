"""Cautions about the scans of a study, and the refusal of too few wavelengths."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from hardcontact.base.formatting import format_length, format_quantity
from hardcontact.commands.inventory import UserScan, scans_by_surface
from hardcontact.commands.proposed_contacts import PermittedContact
from hardcontact.config.faults import raise_faults
from hardcontact.contact.numerical_limits import (
    LARGE_SIZE_RATIO,
    MIN_WINDOW_SHARE,
    SMALLEST_SIZE_RATIO,
    finite_scan_ratio,
    window_share,
)
from hardcontact.scans.defects import defect_sentence
from hardcontact.scans.heights import split_notes
from hardcontact.scans.scan_pairs import describe_contradictions, find_contradictions
from hardcontact.surfaces.spectrum import MIN_BINS, too_few_bins_message

#: Largest share of undefined pixels without a caution.
MAX_UNDEFINED_SHARE = 0.05


def refuse_unreliable(scans: Sequence[UserScan]) -> None:
    """Refuse surfaces with too few reliable wavelengths, and name the defects of their scans."""
    faults = []
    for surface, surface_scans in scans_by_surface(scans).items():
        masks = [scan.reliable_wavelengths.mask for scan in surface_scans]
        bin_count = int(np.any(masks, axis=0).sum())
        if bin_count < MIN_BINS:
            lines = [f"{scan.name} {scan.reliable_wavelengths}" for scan in surface_scans]
            message = too_few_bins_message("scans", bin_count, lines)
            faults.append(f"{surface}: {message}; add one of another size")
            faults += [
                f"{scan.name}: expected a sound scan, found: {defect_sentence(code, numbers)}"
                for scan in surface_scans
                for code, numbers in scan.defects.items()
            ]
    raise_faults(faults)


def scan_cautions(
    scans: Sequence[UserScan],
    substrates: Sequence[UserScan],
    usual_range: float,
    permitted: PermittedContact,
    search_sizes: Mapping[str, float],
) -> Iterator[str]:
    """Yield sentences on all scans, and on contacts on substrates; lengths are in nm."""
    yield from _reading_cautions(scans)
    yield from _contact_cautions(substrates, usual_range, permitted, search_sizes)
    for scan in substrates:
        if not scan.has_reliable_wavelengths:
            yield f"{scan.name}: reliable {scan.reliable_wavelengths}"
    yield from _contradiction_cautions(scans)
    for scan in scans:
        if scan.undefined_share > MAX_UNDEFINED_SHARE:
            yield (
                f"{scan.name}: {scan.undefined_share:.0%} of its pixels are undefined, and "
                "filled with heights smoother than the surface"
            )


def _reading_cautions(scans: Sequence[UserScan]) -> Iterator[str]:
    """Yield sentences on the defects of all scans, then the cautions of their readers."""
    for scan in scans:
        for code, numbers in scan.defects.items():
            yield f"{scan.name}: {defect_sentence(code, numbers)}"
        if "curvature" in scan.defects and scan.scan_file.sphere_radius is not None:
            yield _radius_question(scan, scan.scan_file.sphere_radius)
    for scan in scans:
        _, cautions = split_notes(scan.notes)
        yield from (f"{scan.name}: {line}" for line in cautions)


def _radius_question(scan: UserScan, stated_radius: float) -> str:
    """Return a question about the radius (nm) of a sphere whose scan stays curved."""
    # The curvature has no sign: the stated radius may be too large or too small.
    curvature_left = 1 / scan.defects["curvature"]["curvature_radius"]
    curvatures = (1 / stated_radius + curvature_left, 1 / stated_radius - curvature_left)
    radii = " or ".join(
        format_quantity(1 / curvature, "nm", digits=2) for curvature in curvatures if curvature > 0
    )
    return (
        f"{scan.name}: --radius {format_length(stated_radius)} contradicts this scan of the "
        f"sphere, whose curvature is that of a radius of {radii}: which is right?"
    )


def _contact_cautions(
    substrates: Sequence[UserScan],
    usual_range: float,
    permitted: PermittedContact,
    search_sizes: Mapping[str, float],
) -> Iterator[str]:
    """Yield sentences on contacts on substrates; lengths are in nm."""
    contact = permitted.contact
    if contact.rho > usual_range:
        yield (
            f"the range of adhesion is {contact.rho:.3g} nm, not the usual {usual_range:.3g} nm: "
            f"it is {permitted.range_reason}"
        )
    share = float(window_share(contact, contact.rho))
    if share < MIN_WINDOW_SHARE:
        yield (
            f"the window holds {share:.0%} of the force on a smooth sphere: scans this small "
            "show too little of what the sphere feels, and forces come out too low"
        )
    yield from single_pixel_cautions(contact.area, [scan.pixel_size for scan in substrates])
    for surface, search_size in search_sizes.items():
        size = min(scan.size for scan in substrates if scan.scan_file.surface == surface)
        low, high = finite_scan_ratio(size, search_size)
        if high > 1:
            source = f" on scans of {SMALLEST_SIZE_RATIO:.0%} of this size, the smallest tested"
            is_untested = size < SMALLEST_SIZE_RATIO * search_size
            yield (
                f"{surface}: the sphere finds its highest summits within a search size of some "
                f"{format_length(search_size)}, estimated from single scans (the page has that "
                "of the joined spectrum). Scans of "
                f"{LARGE_SIZE_RATIO:g} times this size are large enough, these are "
                f"{format_length(size)} wide: forces come out {low:g} to {high:g} times too high"
                f"{source if is_untested else ''}"
            )


def single_pixel_cautions(area: float, pixel_sizes: Sequence[float]) -> Iterator[str]:
    """Yield a caution if an area (nm²) smaller than a pixel of some scan carries the preload."""
    largest_pixel_area = max(pixel_sizes, default=0.0) ** 2
    if area < largest_pixel_area:
        yield (
            f"the preload is carried by {area:.3g} nm², less than a pixel of the scans "
            f"({largest_pixel_area:.3g} nm²): one pixel touches, and hardness and preload do not "
            "matter on the scans"
        )


def _contradiction_cautions(scans: Sequence[UserScan]) -> Iterator[str]:
    """Yield a line for each surface whose scans contradict each other."""
    for surface_scans in scans_by_surface(scans).values():
        contradictions = find_contradictions(
            np.array([scan.density for scan in surface_scans]),
            [scan.reliable_wavelengths.mask for scan in surface_scans],
            [scan.kind for scan in surface_scans],
            [scan.size for scan in surface_scans],
        )
        if contradictions:
            yield describe_contradictions(contradictions, [scan.name for scan in surface_scans])
