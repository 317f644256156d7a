"""The page of a study of the user's surfaces."""

from collections.abc import Mapping
from typing import Any

from hardcontact.report.own_surfaces.artificial_roughness import NEARLY_ALL
from hardcontact.report.page import render_page
from hardcontact.report.templates import Frame
from hardcontact.scans.reliable_band import LIMIT_NAMES, MIN_PIXELS, MIN_WAVES_IN_SIZE


def own_page(
    answer: Mapping[str, Any],
    figures: Mapping[str, bytes],
    citation: Mapping[str, Any],
    frame: Frame,
) -> str:
    """Return the page of a study of the user's surfaces; the SVG of figures is by name."""
    limits = {"limit_names": LIMIT_NAMES, "min_pixels": MIN_PIXELS, "min_waves": MIN_WAVES_IN_SIZE}
    return render_page(answer, figures, citation, frame, nearly_all=NEARLY_ALL, **limits)
