"""Say in a sentence what is wrong with a scan, from the code and the numbers of a defect."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import yaml

from hardcontact.base.formatting import format_length, format_share
from hardcontact.scans.defects import DEFECT_UNITS, MIN_SPIKE_DISTANCE, SIDEWALL_PIXEL_SHARE
from hardcontact.surfaces.levelling import MIN_STREAK_STEPS


def defect_sentence(code: str, numbers: Mapping[str, float]) -> str:
    """Return the sentence on a defect, with its numbers and without a full stop."""
    words = {name: _format_number(name, number) for name, number in numbers.items()}
    return _sentences()[code].format(
        **words,
        streak=MIN_STREAK_STEPS,
        spike=MIN_SPIKE_DISTANCE,
        sidewall_pixels=format_share(SIDEWALL_PIXEL_SHARE),
    )


@cache
def _sentences() -> dict[str, str]:
    """Return the sentences on defects by code."""
    text = Path(__file__).with_name("defects.yaml").read_text("utf-8")
    return dict(yaml.safe_load(text))


def _format_number(name: str, number: float) -> str:
    """Return a number of a defect with its unit, a share in per cent."""
    if DEFECT_UNITS[name] == "nm":
        return format_length(number)
    if name.endswith(("_lines", "_line")):
        return f"{number:.0f}"
    number = float(f"{number:.2g}")
    return format_share(number) if name.endswith("_share") else f"{number:g}"
