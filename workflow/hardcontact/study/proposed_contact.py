"""The range of adhesion, the window and the load that scans of any size permit."""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from hardcontact.answer.quantities import print_length, print_quantity
from hardcontact.contact.bearing_area import Load
from hardcontact.contact.geometry import window_pixels
from hardcontact.study.contact_scans import SIZE_OVER_REACH
from hardcontact.study.faults import refuse_all
from hardcontact.study.grid_limits import CONTACT_PIXELS, MAP_PIXELS, least_range
from hardcontact.study.inventory import Entry
from hardcontact.study.master_limits import PENETRATION_OVER_RANGE
from hardcontact.study.proposed_scales import COUNTS, FULL, proposed_tiles

__all__ = ["Contact", "Probe", "contact_cautions", "proposed_contact"]

#: The sphere above its apex at the edge of the window, over the range of adhesion (14 in the paper)
#: and over the rms height.
RANGES_IN_WINDOW, RMS_IN_WINDOW = 14, 4
#: The most images of a scan, mirrored, along an edge of the window: all hold the same summits.
IMAGES = 10
#: The share of the force on a smooth sphere that the window should hold.
SHARE = 0.99
#: The longest range of adhesion that is proposed unasked, in nm: the longest of the paper's study.
LONGEST_RANGE = 40.0


class Probe(NamedTuple):
    """The sphere and its load.

    Attributes
    ----------
    radius : float
        In nm.
    load : Load
        Preload and hardness.
    rho : float
        Range of adhesion in nm.
    rho_given : bool
        Whether the user asked for this range.
    """

    radius: float
    load: Load
    rho: float
    rho_given: bool


class Contact(NamedTuple):
    """What is chosen for contacts.

    Attributes
    ----------
    rho, least : float
        Range of adhesion, and the shortest one that the scans permit, in nm.
    rho_reason : str
        Why it is longer than the usual one, or empty.
    window : float
        Edge of the window in nm, of three digits.
    window_reason : str
        In words.
    """

    rho: float
    least: float
    rho_reason: str
    window: float
    window_reason: str


def proposed_contact(scans: Sequence[Entry], substrates: Sequence[Entry], probe: Probe) -> Contact:
    """Return the range of adhesion and the window.

    Parameters
    ----------
    scans, substrates : sequence of Entry
        On which contacts are made, those of the sphere included and not.
    probe : Probe
        The sphere and its load.

    Returns
    -------
    Contact
        The range asked for, or the usual one made longer if the scans do not permit it.

    Raises
    ------
    ValueError
        In one line a problem: a range that is too short, a preload that is too high.
    """
    window, _ = _window(scans, probe.radius, probe.rho)
    least, why = _least_range(scans, substrates, probe, window)
    rho = max(probe.rho, least)
    # A wider window, as a longer range needs, does not raise the least range.
    window, reason = _window(scans, probe.radius, rho)
    loaded = partial(_refuse_load, scans, probe.load, window)
    refuse_all([partial(_refuse_range, probe, least, why), loaded])
    raised = f"the least on these scans, where {why}" if rho > probe.rho else ""
    return Contact(rho, least, raised, window, reason)


def _refuse_range(probe: Probe, least: float, why: str) -> None:
    """Refuse a range that is too short, if the user asked for it or no range known is as long."""
    if probe.rho < least and (probe.rho_given or least > LONGEST_RANGE):
        found = f"{'' if probe.rho_given else 'the usual '}{probe.rho:.4g} nm"
        raise ValueError(
            f"--range: expected at least {least:.3g} nm on these scans, where {why}, found {found}"
        )


def _window(scans: Sequence[Entry], radius: float, rho: float) -> tuple[float, str]:
    """Return the edge of the window (nm) for a range of adhesion (nm), and the reason."""
    rms_height = max(scan.rms_height for scan in scans)
    finest, least_size = min(scan.pixel_size for scan in scans), min(scan.size for scan in scans)
    height = max(RANGES_IN_WINDOW * rho, RMS_IN_WINDOW * rms_height)
    what = f"{RANGES_IN_WINDOW} ranges of adhesion"
    if RMS_IN_WINDOW * rms_height > RANGES_IN_WINDOW * rho:
        what = f"{RMS_IN_WINDOW} rms heights"
    edge, reason = min(
        (2 * math.sqrt(2 * radius * height), f"at its edge the sphere is {what} above its apex"),
        (MAP_PIXELS * finest, f"{MAP_PIXELS} pixels of the scans, the most that are computed"),
        (2 * IMAGES * least_size, f"{IMAGES} mirrored scans, which all have the same summits"),
    )
    digit = 10.0 ** (math.floor(math.log10(edge)) - 2)
    return float(f"{math.floor(edge / digit) * digit:.3g}"), reason


def _least_range(
    scans: Sequence[Entry], substrates: Sequence[Entry], probe: Probe, window: float
) -> tuple[float, str]:
    """Return the shortest range of adhesion (nm) that scans and masters permit, and why."""
    tiles = proposed_tiles([scan.grid for scan in substrates], window, FULL.pixels)
    limits = [least_range(probe.radius, window, scan.grid) for scan in scans]
    for scan in substrates:
        master = scan.grid._replace(size=scan.size * tiles)
        limits.append(least_range(probe.radius, window, master))
        edge = math.sqrt(probe.load["preload"] / probe.load["hardness"]) * 1e9
        depth = min(edge, scan.relief)
        least = float(f"{1.005 * depth / PENETRATION_OVER_RANGE:.3g}")
        limits.append(
            (least, f"the preload presses the bodies some {depth:.3g} nm into each other")
        )
    return max(limits)


def _refuse_load(scans: Sequence[Entry], load: Load, window: float) -> None:
    """Refuse a preload that needs too many pixels: of the window, of a scan, of the memory."""
    most = math.inf
    for scan in scans:
        pixels = min(window_pixels(window, scan.pixel_size), 2 * scan.pixels) ** 2 // 4
        images = max(1.0, window / (2 * scan.size)) ** 2
        kept = CONTACT_PIXELS / min(COUNTS) ** 2 / images
        area = min(pixels, kept) * (scan.pixel_size * 1e-9) ** 2
        most = min(most, area * load["hardness"])
    if load["preload"] > most:
        raise ValueError(
            f"--preload: expected at most {print_quantity(most, 'N')}, which contacts on these "
            f"scans can carry at this hardness, found {print_quantity(load['preload'], 'N')}"
        )


def contact_cautions(substrates: Sequence[Entry], probe: Probe, contact: Contact) -> Iterator[str]:
    """Yield what the user should know of contacts on these scans, in words.

    Parameters
    ----------
    substrates : sequence of Entry
        The scans that contacts are made on.
    probe : Probe
        The sphere and its load.
    contact : Contact
        As it is proposed.

    Yields
    ------
    str
        A sentence.
    """
    if contact.rho_reason:
        yield (
            f"the range of adhesion is {contact.rho:.3g} nm, not the usual {probe.rho:.3g} nm: it "
            f"is {contact.rho_reason}"
        )
    share = math.erf(contact.window / math.sqrt(8 * probe.radius * contact.rho)) ** 2
    if share < SHARE:
        yield (
            f"the window holds {share:.0%} of the force on a smooth sphere: scans this small "
            "show too little of what the sphere feels, and forces come out too low"
        )
    area = probe.load["preload"] / probe.load["hardness"] * 1e18
    largest = max(scan.pixel_size for scan in substrates)
    if area < largest**2:
        yield (
            f"the preload is carried by {area:.3g} nm², less than a pixel of the scans "
            f"({largest**2:.3g} nm²): one pixel touches, and hardness and preload do not matter "
            "on the scans"
        )
    rms_height = max(scan.rms_height for scan in substrates)
    enough = SIZE_OVER_REACH * math.sqrt(2 * probe.radius * rms_height)
    size = min(scan.size for scan in substrates)
    if size < enough:
        yield (
            f"the sphere finds its highest points within some {print_length(enough)}, the scans "
            f"are {print_length(size)} wide: summits that they miss would change the force"
        )
