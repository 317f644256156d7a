"""Descriptions of substitute surfaces, checked before a spectrum is made from them.

`resources/README.md` says what a description holds.
"""

import math
import os
from collections.abc import Collection, Sequence
from pathlib import Path

import pandas as pd

from hardcontact.config.schema import plain
from hardcontact.config.selection import TABLE_LIMIT
from hardcontact.surfaces.substitute_spectra import CALIBRATED, KNOWN, PARAMETERS, is_calibrated

__all__ = ["refuse_description", "refuse_of_paper"]

#: Models of a band; a power law continues the band above, so that it cannot come first.
MODELS = ("self-affine", "varying Hurst", "smooth roll-off", "profile", "power law")
#: Columns of numbers that may be below zero: local exponents of shoulders are.
SIGNED = ["hurst", "hurst_change"]
#: The local exponent of a C_iso that is constant.
FLATTEST = -1.0
#: Columns of the points of a profile's spectrum.
POINTS = ("wavelength_nm", "c1d_nm3")


def refuse_description(path: str | Path, published: Collection[str]) -> None:
    """Refuse a description of a substitute that no spectrum can be made from.

    Parameters
    ----------
    path : str or Path
        Table of bands (CSV).
    published : collection of str
        Rows of Table 1 that the surface has.

    Raises
    ------
    ValueError
        In one line, naming the file and the line.
    """
    bands = _table(path, PARAMETERS, ("model", "table"))
    columns = zip(bands.model, bands.rolloff_nm, bands.hurst, bands.table, strict=True)
    for line, (model, rolloff, hurst, points) in enumerate(columns, start=2):
        known = [name for name in MODELS if line > 2 or name != "power law"]
        if model not in known:
            raise ValueError(
                f"{path}: line {line}: expected a model, one of {', '.join(known)}; "
                f"found {plain(model)}"
            )
        missing = set(CALIBRATED.get(model, ())).difference(published) if math.isnan(hurst) else ()
        if missing:
            raise ValueError(
                f"{path}: line {line}: expected a Hurst exponent, or of this surface the rows "
                f"{', '.join(sorted(missing))} in resources/paper/table1.csv; found neither"
            )
        if model == "varying Hurst" and math.isnan(rolloff):
            raise ValueError(
                f"{path}: line {line}: expected a roll-off wavelength of a varying Hurst exponent, "
                "found none"
            )
        if hurst < FLATTEST:
            raise ValueError(
                f"{path}: line {line}: expected a Hurst exponent of {FLATTEST:g} or more, below "
                f"which a spectrum grows towards short wavelengths, found {hurst:g}"
            )
        if model == "profile":
            _table(Path(path).parent / str(points), POINTS)


def refuse_of_paper(path: str | Path, surface: str, published: Collection[str]) -> None:
    """Refuse a substitute in a study of own surfaces that stands for one of the paper.

    Parameters
    ----------
    path : str or Path
        Its description, which `refuse_description` accepts.
    surface : str
        Id of the substitute.
    published : collection of str
        Surfaces in the paper's Table 1, which substitutes of these names are conditioned on.

    Raises
    ------
    ValueError
        In one line.
    """
    bands = pd.read_csv(path)
    if surface in published or is_calibrated(bands):
        raise ValueError(
            "config key published: expected paper in a study with substitutes for its surfaces "
            f"({surface}), found none"
        )
    if not bands.basis.isin(KNOWN).any():
        raise ValueError(
            f"{path}: expected, in a study of own surfaces, a band whose basis is "
            f"{' or '.join(KNOWN)}, found {', '.join(map(plain, bands.basis.unique()))}"
        )


def _table(path: str | Path, numbers: Sequence[str], others: Sequence[str] = ()) -> pd.DataFrame:
    """Read a small table (CSV): columns of numbers, blank or not below zero, and other columns.

    Only a Hurst exponent and its change may be below zero.
    """
    columns = [*numbers, *others]
    try:
        if os.path.getsize(path) > TABLE_LIMIT:
            raise ValueError(f"more than {TABLE_LIMIT} bytes")
        table = pd.read_csv(path, compression=None)[columns]
        table = table.astype(dict.fromkeys(numbers, float))
        if table.empty or (table[list(numbers)].drop(columns=SIGNED, errors="ignore") < 0).any(
            axis=None
        ):
            raise ValueError("no row, or a number below zero")
    except (KeyError, OSError, ValueError) as error:
        reason = " ".join(str(error).split())[:200]
        raise ValueError(
            f"{path}: expected a table, comma-separated, with the columns "
            f"{', '.join(columns)} (resources/README.md); found: {reason}"
        ) from None
    return table
