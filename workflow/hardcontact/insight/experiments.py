"""What a published experiment states of a rough contact, and on what basis."""

import math
from collections.abc import Mapping
from typing import NamedTuple

#: Statements without a work of adhesion: a force over that of a smooth sphere; that on the smoother
#: over that on the rougher of two surfaces; d ln F/d ln R; a height (nm) over the mean plane.
RATIO, FALL = "ratio_to_smooth", "fall"
EXPONENT, DISTANCE = "exponent_in_radius", "contact_distance"
HEIGHT, RADIUS = "rms_height_nm", "radius_nm"
#: Begins the names of what is of the second surface of a fall.
ROUGHER = "rougher_"
UNKNOWN = "unknown"


class Cell(NamedTuple):
    """What is known of one quantity: its ends in its unit, of an unknown one those of its prior."""

    basis: str  #: "stated", "inferred", "assumed" or UNKNOWN.
    low: float
    high: float


class Experiment(NamedTuple):
    """One row of the table of experiments (`resources/README.md`)."""

    id: str  #: Names its random numbers.
    label: str
    materials: str
    contact: str  #: "hard"; "soft" or "wet" of negative controls.
    statement: str  #: RATIO, FALL, EXPONENT or DISTANCE.
    rule: str  #: As of `claims.verdicts.accepted_range`.
    measured: float  #: NaN where no number is known, as are ends of its interval.
    low: float
    high: float
    cells: Mapping[str, Cell]  #: By the names of the columns; ends are NaN without a prior.

    @property
    def missing(self) -> list[str]:
        """Names of what a test needs and nobody stated; an exponent needs two radii."""
        needed = [RADIUS, HEIGHT, *([ROUGHER + HEIGHT] if self.statement == FALL else [])]
        lacking = [name for name in needed if math.isnan(self.cells[name].low)]
        radius = self.cells[RADIUS]
        if self.statement == EXPONENT and radius.low == radius.high:
            lacking.append("two_radii")
        return ["measured", *lacking] if math.isnan(self.measured) else lacking
