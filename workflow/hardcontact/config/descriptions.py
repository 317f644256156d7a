"""Checks of the descriptions of substitutes, which `resources/README.md` explains."""

import math
from collections.abc import Collection
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from hardcontact.config.faults import quote_key
from hardcontact.config.keys import Keys
from hardcontact.config.user_files import BLANK_AS_NAN, read_rows
from hardcontact.surfaces.substitute_spectra import (
    CALIBRATION_ROWS,
    DATA_EVIDENCE,
    needs_calibration,
    read_segments,
)

NotNegative = Annotated[float, Field(strict=False, ge=0, allow_inf_nan=False), BLANK_AS_NAN]


class SegmentRow(Keys, extra="ignore"):
    """A row of a description: a segment of the spectrum, from one wavelength to another."""

    longest_nm: Annotated[float, Field(strict=False, ge=0), BLANK_AS_NAN]  #: May be infinite.
    shortest_nm: NotNegative
    plateau_nm4: NotNegative
    rolloff_nm: NotNegative
    # At H = -1, C_iso is constant; for smaller H it would grow towards short wavelengths.
    hurst: Annotated[float, Field(strict=False, ge=-1, allow_inf_nan=False), BLANK_AS_NAN]
    hurst_change: Annotated[float, Field(strict=False, allow_inf_nan=False), BLANK_AS_NAN]
    model: Literal["self-affine", "varying Hurst", "smooth roll-off", "profile", "power law"]
    table: str
    evidence: str

    @model_validator(mode="after")
    def _check_rolloff(self) -> "SegmentRow":
        if self.model == "varying Hurst" and math.isnan(self.rolloff_nm):
            raise ValueError("rolloff_nm: expected a number for a varying exponent, found none")
        return self


class ProfileRow(Keys, extra="ignore"):
    """A point of the spectrum of a profile, which is a row of its table."""

    wavelength_nm: NotNegative
    c1d_nm3: NotNegative


def refuse_description(path: str | Path, published_rows: Collection[str]) -> None:
    """Refuse a description that gives no spectrum, even with its surface's rows of Table 1."""
    content = "a table with the columns {} (resources/README.md)"
    rows = read_rows(path, SegmentRow, content)
    for line, row in rows.items():
        if row.model == "power law" and line == min(rows):
            raise ValueError(
                f"{path}: line {line}: model: expected another in the first row, because a power "
                "law continues the segment above, found power law"
            )
        missing_rows = set(CALIBRATION_ROWS.get(row.model, ())).difference(published_rows)
        if missing_rows and math.isnan(row.hurst):
            raise ValueError(
                f"{path}: line {line}: hurst: expected an exponent, or the rows "
                f"{', '.join(sorted(missing_rows))} of this surface in resources/paper/table1.csv; "
                "found neither"
            )
        if row.model == "profile":
            read_rows(Path(path).parent / row.table, ProfileRow, content)


def refuse_in_own_study(path: str | Path, surface: str, published: Collection[str]) -> None:
    """Refuse a substitute for the paper's surfaces, or one without data, in a study of others."""
    segments = read_segments(path)
    if surface in published or needs_calibration(segments):
        raise ValueError(
            "config key published: expected paper in a study with substitutes for the paper's "
            f"surfaces ({surface}), found none"
        )
    if not segments.evidence.isin(DATA_EVIDENCE).any():
        evidence = ", ".join(map(quote_key, segments.evidence.unique()))
        raise ValueError(
            f"{path}: expected, in a study of your surfaces, a segment whose evidence is "
            f"{' or '.join(DATA_EVIDENCE)}, found {evidence}"
        )
