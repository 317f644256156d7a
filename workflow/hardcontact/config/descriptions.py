"""Checks of the descriptions of substitute surfaces (`resources/README.md`)."""

import math
from collections.abc import Collection, Sequence
from functools import partial
from pathlib import Path

from hardcontact.config.faults import quote_key
from hardcontact.config.tables import Row, parse_number, user_table
from hardcontact.surfaces.substitute_spectra import (
    DATA_EVIDENCE,
    DESCRIPTION_NUMBERS,
    needs_calibration,
    read_segments,
)
from hardcontact.surfaces.table1_calibration import CALIBRATION_ROWS

#: Models of a segment; a power law extrapolates the segment above, so that it cannot come first.
SEGMENT_MODELS = ("self-affine", "varying Hurst", "smooth roll-off", "profile", "power law")
#: Columns of numbers that may be below zero: local exponents of shoulders are.
SIGNED_COLUMNS = ("hurst", "hurst_change")
#: Smallest Hurst exponent: C_iso is then constant.
MIN_HURST = -1.0
#: Columns of the points of a profile's spectrum.
PROFILE_COLUMNS = ("wavelength_nm", "c1d_nm3")


def refuse_description(path: str | Path, published_rows: Collection[str]) -> None:
    """Refuse a description without a spectrum; the published rows are the surface's in Table 1."""
    rows = _read_rows(path, DESCRIPTION_NUMBERS, ("model", "table"))
    for line, row in rows.items():
        fault = _segment_fault(row, line == min(rows), published_rows)
        if fault:
            raise ValueError(f"{path}: line {line}: expected {fault}")
        if row["model"] == "profile":
            _read_rows(Path(path).parent / row["table"], PROFILE_COLUMNS)


def _segment_fault(row: Row, is_longest: bool, published_rows: Collection[str]) -> str:
    """Return the fault of a segment, as expected and found; no text if the segment is sound."""
    model = row["model"]
    models = [name for name in SEGMENT_MODELS if not (is_longest and name == "power law")]
    if model not in models:
        return f"a model, one of {', '.join(models)}; found {quote_key(model)}"
    missing_rows = set(CALIBRATION_ROWS.get(model, ())).difference(published_rows)
    if missing_rows and not row["hurst"]:
        return (
            f"a Hurst exponent, or the rows {', '.join(sorted(missing_rows))} of this surface in "
            "resources/paper/table1.csv; found neither"
        )
    if model == "varying Hurst" and not row["rolloff_nm"]:
        return "a roll-off wavelength of a varying Hurst exponent, found none"
    if parse_number(row["hurst"]) < MIN_HURST:
        return (
            f"a Hurst exponent of {MIN_HURST:g} or more, below which a spectrum grows towards "
            f"short wavelengths, found {parse_number(row['hurst']):g}"
        )
    return ""


def refuse_paper_surface(path: str | Path, surface: str, published: Collection[str]) -> None:
    """Refuse a substitute for a surface of the paper in a study of the user's surfaces.

    `refuse_description` must accept the description. `published` are the surfaces in the paper's
    Table 1, to which substitutes with these names are conditioned. Raises ValueError with one line.
    """
    segments = read_segments(path)
    if surface in published or needs_calibration(segments):
        raise ValueError(
            "config key published: expected paper in a study with substitutes for its surfaces "
            f"({surface}), found none"
        )
    if not segments.evidence.isin(DATA_EVIDENCE).any():
        evidence = ", ".join(map(quote_key, segments.evidence.unique()))
        raise ValueError(
            f"{path}: expected, in a study of your surfaces, a segment whose evidence is "
            f"{' or '.join(DATA_EVIDENCE)}, found {evidence}"
        )


def _read_rows(
    path: str | Path, numbers: Sequence[str], text_columns: Sequence[str] = ()
) -> dict[int, Row]:
    """Return the rows of a table by line; cells in columns of numbers are numbers or blank."""
    columns = (*numbers, *text_columns)
    content = f"a table with the columns {', '.join(columns)} (resources/README.md)"
    table = user_table(path, content)
    table.require(columns, content)
    return table.convert(partial(_check_numbers, numbers=numbers))


def _check_numbers(row: Row, numbers: Sequence[str]) -> Row:
    """Return a row; refuse one whose cells in columns of numbers are neither numbers nor blank."""
    for name in numbers:
        low = -math.inf if name in SIGNED_COLUMNS else 0
        number = parse_number(row[name] or "0")
        if not low <= number or (math.isinf(number) and name != "longest_nm"):
            accepted = "a number" if name in SIGNED_COLUMNS else "a number, none below zero"
            raise ValueError(f"{name}: expected {accepted}, found {quote_key(row[name])}")
    return row
