"""The keys that intermediates depend on: each path contains a digest of their values.

The digest omits keys whose values are in the path themselves. A source of a surface, or another row
in the table of surfaces, is not a key: it replaces the intermediates of that surface.
"""

import hashlib
from collections.abc import Mapping
from typing import Any

from hardcontact.base.origin import canonical
from hardcontact.config.configuration import get_key

_READING = ("scan.undefined_pixels", "scan.unit", "scan.map_size")
_MEASURED = (*_READING, "scan.levelling", "scans")
_GAUSSIAN = ("seed", "scans", "scan.pixels", "scan.size")
_SUBSTITUTES = (*_GAUSSIAN, "scan.featured_surface")
#: Keys on which every scan, measured or substitute, and everything computed from scans depend.
SCAN_KEYS = (*_SUBSTITUTES, *_MEASURED)
_CONTACTS = (*SCAN_KEYS, "contact.window", "contact.count")
_DRAWS = (*_GAUSSIAN, "sets.count", "contact.window", "adhesion.ranges")
_TRANSITIONS = ("scales.small.transition", "scales.large.transition")

#: The keys of each kind of intermediate and of its inputs.
STORE_KEYS = {
    "measurements": _READING,
    "measured_spectra": _MEASURED,
    "sampled_spectra": (*_MEASURED, "seed"),
    "conditioning": SCAN_KEYS,  # which is made with the scans
    "scans": SCAN_KEYS,
    "stitched": SCAN_KEYS,
    "pull_off": (*_CONTACTS, "adhesion.ranges"),
    "elastic": (*_CONTACTS, "elastic.contacts"),
    "asperities": (*_CONTACTS, "asperities"),
    "smooth_sphere": (*_CONTACTS, "adhesion.ranges"),
    "whole": (*_CONTACTS, "adhesion.ranges", "scales.large.tiles"),
    "octaves": _CONTACTS,
    "pool": (*_DRAWS, "sets.rms_heights"),
    "draws": _DRAWS,
    "masters": (*SCAN_KEYS, *_TRANSITIONS, "scales.small.pixels", "scales.large.tiles"),
}


def short_digest(values: object) -> str:
    """Return a short digest of values, as a part of paths."""
    return hashlib.sha256(canonical(values).encode()).hexdigest()[:8]


def key_values(configuration: Mapping[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    """Return the values of keys, with dots between their parts."""
    return {key: get_key(configuration, key) for key in keys}


def store_digests(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the digest of the keys of each kind of intermediate."""
    return {
        kind: short_digest(key_values(configuration, keys)) for kind, keys in STORE_KEYS.items()
    }
