"""The window and the range of adhesion of a study of own surfaces, from its scans."""

import math
from collections.abc import Sequence
from dataclasses import replace

from hardcontact.config.grids import (
    MAP_PIXELS,
    PENETRATION_OVER_RANGE,
    minimum_range,
    penetration_depth,
)
from hardcontact.contact.contact import Contact
from hardcontact.own.inventory import Entry

#: Height of the sphere above its apex at the border of the window, relative to the range of
#: adhesion (14 in the paper) and to the rms height.
RANGES_IN_WINDOW = 14
RMS_IN_WINDOW = 4
#: Largest number of mirrored scans along a side of the window: all have the same summits.
MAX_IMAGES = 10
#: The longest range of adhesion (nm) that is proposed if none is given: that of the paper's study.
LONGEST_RANGE = 40.0
#: Edge of the large-scale master relative to that of a scan, and to the window.
MASTER_SCANS = 8
MASTER_WINDOWS = 1.6


def choose_window(
    scans: Sequence[Entry],
    substrates: Sequence[Entry],
    probe: Contact,
    range_given: bool,
    max_pixels: int,
) -> tuple[Contact, float, dict[str, str]]:
    """Return the probe with a window, and with a longer range of adhesion if the scans need it.

    `scans` includes the scans of the sphere, `substrates` does not; masters have at most
    `max_pixels` along a side. Also returns the shortest range (nm) that the scans permit, and the
    reasons for window and range by key. The limits of the study refuse a range that stays too
    short.
    """
    window, _ = _window(scans, probe.radius, probe.range)
    shortest, reason = _shortest_range(scans, substrates, probe, window, max_pixels)
    rho = probe.range
    range_reason = "as given" if range_given else "the paper's"
    if shortest > rho and not range_given:
        rho = max(rho, min(shortest, LONGEST_RANGE))
        range_reason = f"the least on these scans, where {reason}"
    # A wider window, as a longer range needs, does not raise the shortest range.
    window, window_reason = _window(scans, probe.radius, rho)
    reasons = {"contact.window": window_reason, "scales.range": range_reason}
    return replace(probe, range=rho, window=window), shortest, reasons


def _window(scans: Sequence[Entry], radius: float, rho: float) -> tuple[float, str]:
    """Return the side of the window (nm) for a range of adhesion (nm), and the reason."""
    rms_height = max(scan.rms_height for scan in scans)
    finest = min(scan.pixel_size for scan in scans)
    smallest = min(scan.size for scan in scans)
    height = RANGES_IN_WINDOW * rho
    height_words = f"{RANGES_IN_WINDOW} ranges of adhesion"
    if RMS_IN_WINDOW * rms_height > height:
        height = RMS_IN_WINDOW * rms_height
        height_words = f"{RMS_IN_WINDOW} rms heights"
    window, reason = min(
        (
            2 * math.sqrt(2 * radius * height),
            f"at its border the sphere is {height_words} above its apex",
        ),
        (MAP_PIXELS * finest, f"{MAP_PIXELS} pixels of the scans, the most that are computed"),
        (
            2 * MAX_IMAGES * smallest,
            f"{MAX_IMAGES} mirrored scans, which all have the same summits",
        ),
    )
    digit = 10.0 ** (math.floor(math.log10(window)) - 2)
    return float(f"{math.floor(window / digit) * digit:.3g}"), reason


def _shortest_range(
    scans: Sequence[Entry],
    substrates: Sequence[Entry],
    probe: Contact,
    window: float,
    max_pixels: int,
) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm) that scans and masters permit, and why."""
    tiles = count_tiles(substrates, window, max_pixels)
    limits = [minimum_range(probe.radius, window, scan.grid) for scan in scans]
    for scan in substrates:
        master = scan.grid._replace(size=scan.size * tiles)
        limits.append(minimum_range(probe.radius, window, master))
        depth = penetration_depth(probe, scan.relief)
        depth_reason = f"the preload presses the bodies some {depth:.3g} nm into each other"
        limits.append((float(f"{1.005 * depth / PENETRATION_OVER_RANGE:.3g}"), depth_reason))
    return max(limits)


def count_tiles(substrates: Sequence[Entry], window: float, pixels: int) -> int:
    """Return the number of stitched scans along a side of large-scale masters.

    The master is eight scans long, as in the paper, and longer than the window (nm), if its number
    of pixels suffices.
    """
    size = min(scan.size for scan in substrates)
    tiles = math.ceil(max(MASTER_SCANS * size, MASTER_WINDOWS * window) / (2 * size) * (1 - 1e-9))
    return max(1, min(tiles, pixels // max(2 * scan.pixels for scan in substrates)))
