"""The radius of the tip, where a file or a container states it."""

import re
from typing import Any

from hardcontact.surfaces.scan_limits import LENGTHS, RefusedScan, unit_in_nm

__all__ = ["stated_tip_radius"]

#: "Tip radius: 8 nm", "Initial tip radii - 17 nm" and the like in the words of a container.
IN_WORDS = re.compile(r"\btip\s+radi(?:us|i)\b[\s:=~≈\-–]*(\d+(?:\.\d+)?)\s*(nm|µm|μm|um)\b", re.I)


def stated_tip_radius(
    of_file: dict[str, Any], of_container: dict[str, Any]
) -> tuple[float | None, list[str]]:
    """Return the radius of the tip and where it was found.

    What the file states counts before what its container does, and a number before words. Of
    several radii in words the largest counts: tips wear, and a scan shows no more than a worn one.

    Parameters
    ----------
    of_file : dict
        Metadata of a topography, as SurfaceTopography returns them.
    of_container : dict
        What a contact.engineering container says of it; empty of any other file.

    Returns
    -------
    radius : float or None
        In nm.
    notes : list of str
        In words for the user; empty if there is none.
    """
    for source, metadata in (("file", of_file), ("container", of_container)):
        radius = _in_numbers(metadata)
        if radius is not None:
            return radius, [f"tip radius of {radius:.4g} nm stated by the {source}"]
    stated = IN_WORDS.findall(str(of_container.get("description") or ""))
    radii = [float(value) * unit_in_nm(unit) for value, unit in stated]
    if not radii:
        return None, []
    found = " and ".join(f"{radius:.4g} nm" for radius in radii)
    used = "" if len(radii) == 1 else ", of which the largest is used"
    return max(radii), [f"tip radius of {found} in the container's description{used}"]


def _in_numbers(metadata: dict[str, Any]) -> float | None:
    """Return the radius (nm) in metadata of an instrument, if they state one that a tip may have.

    These are the keys of ``InfoModel`` and of ``TopographyMeta`` of SurfaceTopography.
    """
    try:
        stated = metadata["instrument"]["parameters"]["tip_radius"]
        radius = float(stated["value"]) * unit_in_nm(stated["unit"])
    except (LookupError, TypeError, ValueError, RefusedScan):
        return None
    least, most = LENGTHS
    return radius if least <= radius <= most else None
