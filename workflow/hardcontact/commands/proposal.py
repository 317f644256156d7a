"""What a study of own surfaces computes, with reasons in words, and the overlay that says so.

Every key that depends on the scans follows from what the files hold and from the few options of the
command line.
"""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import yaml

from hardcontact.commands.inventory import FILLING, Entry
from hardcontact.commands.proposed_contact import (
    Contact,
    Probe,
    contact_cautions,
    contact_scans,
    proposed_contact,
)
from hardcontact.commands.proposed_scales import (
    FULL,
    QUICK,
    Effort,
    Scales,
    Setting,
    proposed_scales,
)
from hardcontact.config.schema import refuse_lines
from hardcontact.numbers.printing import print_length
from hardcontact.surfaces.joined_spectrum import FEWEST
from hardcontact.surfaces.spectrum import BIN_EDGES

#: Pixels of the shortest wave that is kept of a scan, and the longest one over its size, as in the
#: paper: 20 nm and 1000 nm of scans of 2500 nm with 512 pixels.
TRANSITION_PIXELS, TRANSITION_SHARE = 4, 0.4
#: The range of adhesion over the shortest, and the longest over it, that forces are computed at.
RANGE_SPAN = 8.0
#: Ranges of adhesion (nm) that the configuration accepts.
RANGES = (0.01, 1000.0)
#: Characters of a line of an overlay.
WIDTH = 100


class Choice(NamedTuple):
    """A value that is chosen, as YAML has it: its key with dots, and a reason or nothing."""

    key: str
    value: object
    reason: str


class Proposal(NamedTuple):
    """What is proposed.

    The scans that contacts are made on (all others only enter the spectrum), what is chosen for the
    study and what differs at quick effort, reasons for the scans of each surface, and what the user
    should know before believing the answer.
    """

    contact: list[Entry]
    choices: list[Choice]
    quick: list[Choice]
    reasons: list[str]
    cautions: list[str]


def propose(entries: Sequence[Entry], sphere: str | None, probe: Probe) -> Proposal:
    """Choose every key that depends on the scans of surfaces, and of the sphere if it is rough.

    A ValueError tells in one line a problem: no height map, surfaces with scans too different for
    one study, a range of adhesion that is too short, a preload that is too high.
    """
    scans, reasons = contact_scans(entries, sphere, probe.radius, probe.rho)
    substrates = [scan for scan in scans if scan.source.surface != sphere]
    _refuse_different(substrates)
    contact = proposed_contact(scans, substrates, probe)
    full, quick = (_choices(substrates, probe, contact, effort) for effort in (FULL, QUICK))
    usual = {choice.key: choice.value for choice in full}
    return Proposal(
        scans,
        [*_filling(entries), *full],
        [choice._replace(reason="") for choice in quick if choice.value != usual[choice.key]],
        reasons,
        [*contact_cautions(substrates, probe, contact), *_band_cautions(substrates)],
    )


def refuse_unreliable(entries: Sequence[Entry]) -> None:
    """Refuse surfaces of which too few wavelengths are reliable for a spectrum, a line each."""
    wavelength = 2 * np.pi / np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
    faults = []
    for surface in dict.fromkeys(entry.source.surface for entry in entries):
        scans = [entry for entry in entries if entry.source.surface == surface]
        reliable = [
            (scan.band.shortest <= wavelength) & (wavelength <= scan.band.longest) for scan in scans
        ]
        count = int(np.any(reliable, axis=0).sum())
        if count < FEWEST:
            found = "; ".join(map(_band_ends, scans))
            faults.append(
                f"{surface}: expected scans that are reliable in at least {FEWEST} bins of "
                f"wavelengths (ten a decade), found {count}: {found}; add one of another size"
            )
    refuse_lines(faults)


def _band_ends(scan: Entry) -> str:
    """Return what ends the reliable wavelengths of a scan, in words."""
    band = scan.band
    return (
        f"{scan.name} from {print_length(band.shortest)} ({band.shortest_reason}) "
        f"to {print_length(band.longest)} ({band.longest_reason})"
    )


def _refuse_different(substrates: Sequence[Entry]) -> None:
    """Refuse surfaces whose scans have no wavelength in common."""
    coarsest = max(substrates, key=lambda scan: scan.pixel_size)
    smallest = min(substrates, key=lambda scan: scan.size)
    if TRANSITION_PIXELS * coarsest.pixel_size > TRANSITION_SHARE * smallest.size:
        raise ValueError(
            "--surface: expected scans of similar size on all surfaces, found "
            f"{print_length(smallest.size)} on {smallest.source.surface} and pixels of "
            f"{print_length(coarsest.pixel_size)} on {coarsest.source.surface}: "
            "make a study of each"
        )


def _choices(
    substrates: Sequence[Entry], probe: Probe, contact: Contact, effort: Effort
) -> list[Choice]:
    """Return what is computed at some effort."""
    counts = [scan.source.surface for scan in substrates]
    setting = Setting(
        [scan.grid for scan in substrates],
        max(map(counts.count, counts)),
        probe.load,
        probe.radius,
        contact.rho,
        contact.window,
    )
    scales = proposed_scales(setting, effort)
    ranges = _quantities(_ranges(contact, effort.ranges))
    permitted = f"these scans permit {contact.least:.3g} nm or more"
    why = contact.rho_reason or ("as given" if probe.rho_given else "the paper's")
    return [
        Choice("contact.window", quantity(contact.window), contact.window_reason),
        Choice("contact.count", scales.contacts, "contacts along an edge of their array"),
        Choice("adhesion.ranges", ranges, f"for the force as a function of it; {permitted}"),
        Choice("scales.range", quantity(contact.rho), why),
        Choice("scales.realizations", scales.realizations, "masters on each side"),
        *_master_choices(substrates, scales),
    ]


def _master_choices(substrates: Sequence[Entry], scales: Scales) -> Iterator[Choice]:
    """Yield what masters and their filters are."""
    shortest, longest, shortest_reason = _transitions(substrates)
    longest_reason = f"{TRANSITION_SHARE:g} of the size of the scan; above, roughness is artificial"
    size = 2 * min(scan.size for scan in substrates)
    pixel = max(2 * scan.size / scales.small_pixels for scan in substrates)
    edge = f"mirrored scans along an edge, {print_length(size * scales.tiles)}"
    small, large = (
        _quantities(cutoffs) for cutoffs in (scales.small_cutoffs, scales.large_cutoffs)
    )
    yield Choice("scales.small.pixels", scales.small_pixels, f"{print_length(pixel)} a pixel")
    yield Choice("scales.small.transition", quantity(shortest), shortest_reason)
    yield Choice("scales.small.cutoffs", small, "from four pixels to the size of the scan")
    yield Choice("scales.large.pixels", scales.large_pixels, "those of the scans")
    yield Choice("scales.large.tiles", scales.tiles, edge)
    yield Choice("scales.large.transition", quantity(longest), longest_reason)
    yield Choice("scales.large.cutoffs", large, "to half the size of the master")


def _transitions(substrates: Sequence[Entry]) -> tuple[float, float, str]:
    """Return the wavelengths (nm) beyond which roughness is artificial, and why the shorter one."""
    longest = TRANSITION_SHARE * min(scan.size for scan in substrates)
    ends = [(TRANSITION_PIXELS * scan.pixel_size, "four pixels") for scan in substrates]
    ends += [(scan.band.shortest, scan.band.shortest_reason) for scan in substrates]
    shortest, reason = max(ends)
    longest, shortest = (float(f"{wavelength:.3g}") for wavelength in (longest, shortest))
    if shortest > longest:
        return longest, longest, f"no wave of the scan is reliable ({reason})"
    return shortest, longest, f"{reason}; below, roughness is artificial"


def _ranges(contact: Contact, count: int) -> list[float]:
    """Return ranges of adhesion (nm) about that of the masters, which is one of them."""
    least, most = RANGES
    shortest = max(contact.least, contact.rho / RANGE_SPAN, least)
    longest = min(contact.rho * RANGE_SPAN, most)
    below = np.geomspace(shortest, contact.rho, count // 2 + 1)[:-1]
    above = np.geomspace(contact.rho, longest, count - count // 2)[1:]
    rounded = {float(f"{rho:.2g}") for rho in (*below[1:], *above)}
    others = {rho for rho in rounded if rho > shortest}
    return sorted({shortest, contact.rho, *others})


def _filling(entries: Sequence[Entry]) -> Iterator[Choice]:
    """Yield that gaps are filled, if there are any."""
    count = sum(entry.undefined > 0 for entry in entries)
    if count:
        yield Choice(
            "scan.undefined_pixels", FILLING, f"{count} of the files have undefined pixels"
        )


def _band_cautions(substrates: Sequence[Entry]) -> Iterator[str]:
    """Yield which scans of contacts have no reliable wavelength, in words."""
    for scan in substrates:
        if scan.band.shortest > scan.band.longest:
            yield (
                f"{scan.name}: no wavelength is reliable: {scan.band.shortest_reason}, but "
                f"{scan.band.longest_reason} ends at {print_length(scan.band.longest)}"
            )


def _quantities(lengths: Sequence[float]) -> list[str]:
    return [quantity(length) for length in lengths]


def quantity(length: float) -> str:
    """Return a length (nm) as the configuration has it."""
    return f"{length:.12g} nm"


def nested(choices: Sequence[Choice], base: Mapping[str, Any]) -> dict[str, Any]:
    """Return a configuration with the values of choices, the last of several, for its own."""
    config = dict(base)
    for key, value, _ in choices:
        *branch, last = key.split(".")
        place = config
        for part in branch:
            place[part] = place = dict(place.get(part, {}))
        place[last] = value
    return config


def overlay_text(head: Sequence[str], choices: Sequence[Choice], quick: Sequence[Choice]) -> str:
    """Return an overlay with a comment for every choice that has a reason, as YAML.

    Below the lines of a head stand the keys of the study, and those that count with `effort:
    quick`.
    """
    of_quick = [choice._replace(key=f"quick.{choice.key}") for choice in quick]
    lines = [f"# {line}" for line in head]
    lines += ["", *_section(choices), "", "# With --config effort=quick these replace those above."]
    return "\n".join([*lines, *_section(of_quick)]) + "\n"


def _section(choices: Sequence[Choice], depth: int = 0) -> Iterator[str]:
    """Yield the lines of choices whose keys are the same up to one depth."""
    groups: dict[str, list[Choice]] = {}
    for choice in choices:
        groups.setdefault(choice.key.split(".")[depth], []).append(choice)
    indent = depth * "  "
    for name, group in groups.items():
        if group[0].key.count(".") > depth:
            yield f"{indent}{name}:"
            yield from _section(group, depth + 1)
        else:
            yield from _commented(f"{indent}{name}: ", indent, group[0])


def _commented(start: str, indent: str, choice: Choice) -> Iterator[str]:
    """Yield a key with its value, and its reason beside it or, if that is too long, above it."""
    lines = _value_lines(start, indent, choice.value)
    beside = f"{lines[0]:32} # {choice.reason}"
    if choice.reason and len(lines) == 1 and len(beside) <= WIDTH:
        yield beside
        return
    if choice.reason:
        comment = f"{indent}# "
        yield from textwrap.wrap(
            choice.reason, WIDTH, initial_indent=comment, subsequent_indent=comment
        )
    yield from lines


def _value_lines(start: str, indent: str, value: object) -> list[str]:
    """Return a key and its value as YAML, long lists on several lines."""
    if not isinstance(value, list):
        return [start + _scalar(value)]
    # An item stays on one line: its spaces are no places to break at.
    items = ", ".join(_scalar(item).replace(" ", "\0") for item in value)
    text = f"{start.strip()} [{items}]"
    hanging = f"{indent}  "
    lines = textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=hanging)
    return [line.replace("\0", " ") for line in lines]


def _scalar(value: object) -> str:
    text = yaml.safe_dump([value], default_flow_style=True, allow_unicode=True, width=2**20)
    return str(text).strip()[1:-1]
