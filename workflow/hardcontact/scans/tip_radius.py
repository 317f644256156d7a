"""Find the radius of the tip that a file or its container states."""

import re
from typing import Any

from hardcontact.scans.heights import LENGTH_BOUNDS, RefusedFile, unit_in_nm

#: "Tip radius: 8 nm", "Initial tip radii - 17 nm" and the like in the words of a container.
TIP_RADIUS_IN_WORDS = re.compile(
    r"\btip\s+radi(?:us|i)\b[\s:=~≈\-–]*(\d+(?:\.\d+)?)\s*(nm|µm|μm|um)\b", re.I
)


def stated_tip_radius(
    file: dict[str, Any], container: dict[str, Any]
) -> tuple[float | None, list[str]]:
    """Return the radius of the tip in nm, and a note that says who states it; None if nobody does.

    The file has precedence over its container, and a number over words. The largest radius in words
    counts, because a worn tip limits the scan.
    """
    for source, metadata in (("file", file), ("container", container)):
        radius = _radius_in_numbers(metadata)
        if radius is not None:
            return radius, [f"tip radius of {radius:.4g} nm stated by the {source}"]
    matches = TIP_RADIUS_IN_WORDS.findall(str(container.get("description") or ""))
    if not matches:
        return None, []
    radius = max(float(value) * unit_in_nm(unit) for value, unit in matches)
    return radius, [f"largest tip radius in the container's description, {radius:.4g} nm"]


def _radius_in_numbers(metadata: dict[str, Any]) -> float | None:
    """Return the radius (nm) of the instrument's tip in metadata; None if it is not plausible."""
    try:
        tip_radius = metadata["instrument"]["parameters"]["tip_radius"]
        radius = float(tip_radius["value"]) * unit_in_nm(tip_radius["unit"])
    except (LookupError, TypeError, ValueError, RefusedFile):
        return None
    return radius if LENGTH_BOUNDS[0] <= radius <= LENGTH_BOUNDS[1] else None
