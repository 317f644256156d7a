"""Read your measured forces: a table of single forces, or mean and median of each surface."""

import difflib
import re
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

import pandas as pd

from hardcontact.base.units import FACTORS, NANOMETRE, parse_quantity
from hardcontact.config.faults import SIMILARITY, quote_key, raise_faults
from hardcontact.config.key_types import Quantity
from hardcontact.config.user_files import Row, decode_utf8, parse_number, user_table

#: Columns of a table of single forces.
SINGLE_COLUMNS = ("surface", "value", "unit")
#: Columns of a table with one row per surface.
SUMMARY_COLUMNS = ("surface", "mean", "median", "count", "unit")
#: Columns that are read. Forces at one `site`, an optional name, are not independent.
KNOWN_COLUMNS = {*SINGLE_COLUMNS, *SUMMARY_COLUMNS, "site"}
#: Other names of `site`, which are refused, because ignored sites would be independent.
SITE_SYNONYMS = ("place", "position", "location", "spot")
#: Columns whose cells are forces.
FORCE_COLUMNS = ("value", "mean", "median")
#: A column with its unit, such as "force (uN)" or "pull-off [nN]".
COLUMN_WITH_UNIT = re.compile(r"(.*?)\s*[(\[]\s*(\S+?)\s*[)\]]")
#: Units of force, and of force over the radius of the probe.
FORCE_UNITS = {*FACTORS["N"], *(unit for unit in FACTORS["J/m2"] if unit.endswith("N/m"))}
#: A pull-off force: 1 fN, below what any instrument measures, to the weight of 100 kg.
FORCE_QUANTITY = Quantity("N", 1e-15, 1e3)


def read_forces(
    path: str | Path, surfaces: Collection[str], radius: float, named_by: str = "config key forces"
) -> pd.DataFrame:
    """Return your pull-off forces on the surfaces of a study, by line of the file.

    The columns are surface, mean and median in N, count of forces, and site. A force over the
    radius of the probe is multiplied by the `radius` (nm).
    """
    table = user_table(path, f"a table of forces ({named_by})", decode=_decode_forces)
    header, units = _split_units(table.header)
    table = table._replace(header=header)
    columns = SUMMARY_COLUMNS if "mean" in header else SINGLE_COLUMNS
    defaults = {"surface": next(iter(surfaces))} if len(surfaces) == 1 else {}
    defaults |= {"unit": ""} if units else {}
    table.require_columns(
        [name for name in columns if name not in defaults],
        f"a row per force, columns {', '.join(SINGLE_COLUMNS)} or {', '.join(SUMMARY_COLUMNS)}, "
        "separated by commas; a column such as value (uN) needs no unit, one surface no name",
    )
    resembled_names = [*KNOWN_COLUMNS, *SITE_SYNONYMS]
    raise_faults(
        f"{path}: expected no column whose name resembles another, found {quote_key(name)} (did "
        f"you mean {'site' if similar in SITE_SYNONYMS else similar}?)"
        for name in set(header) - KNOWN_COLUMNS
        for similar in difflib.get_close_matches(name, resembled_names, n=1, cutoff=SIMILARITY)
    )
    rows = table.map_rows(lambda row: _parse_force(defaults | dict(row), units, surfaces, radius))
    names = ["surface", "mean", "median", "count", "site"]
    forces = pd.DataFrame.from_dict(rows, orient="index", columns=names).rename_axis("line")
    if columns == SUMMARY_COLUMNS:
        raise_faults(
            f"{path}: line {line}: expected each surface once, found again {quote_key(surface)}"
            for line, surface in forces.surface[forces.duplicated("surface")].items()
        )
    return forces


def _decode_forces(content: bytes) -> str:
    """Return a text in UTF-8, or in Latin-1 if it has no control characters."""
    try:
        return decode_utf8(content)
    except UnicodeDecodeError:
        text = content.decode("latin-1")
        if "".join(text.split()).isprintable():
            return text
        raise


def _split_units(header: Sequence[str]) -> tuple[list[str], dict[str, str]]:
    """Return the columns of a header in lower case, and the units of its columns of forces.

    If no column is named value, mean or median, the only column with a unit of force is `value`.
    """
    names = []
    units = {}
    for cell in header:
        match = COLUMN_WITH_UNIT.fullmatch(cell)
        if match and match[2] in FORCE_UNITS:
            names.append(match[1].lower())
            units[names[-1]] = match[2]
        else:
            names.append(cell.lower())
    if len(units) == 1 and not set(FORCE_COLUMNS) & set(names):
        [(name, unit)] = units.items()
        names[names.index(name)] = "value"
        return names, {"value": unit}
    return names, {name: unit for name, unit in units.items() if name in FORCE_COLUMNS}


def _parse_force(
    row: Row, units: Mapping[str, str], surfaces: Collection[str], radius: float
) -> tuple[str, float, float, int, str]:
    """Return surface, mean and median in N, count and site of a row."""
    surface = row["surface"]
    count = row.get("count", "1")
    forces = []
    # A single force is its own mean and median.
    for name in ("mean", "median") if "mean" in row else ("value", "value"):
        unit = units.get(name, row["unit"])
        written = f"{row[name]} {unit}"
        if parse_number(row[name]) == 0 or row[name].startswith("<"):
            raise ValueError(
                f"{name}: expected a force above zero, found {quote_key(row[name])}: for a force "
                "below the noise write the noise, which makes the mean an upper bound"
            )
        if parse_number(row[name]) < 0:
            raise ValueError(
                f"{name}: expected forces above zero, found {quote_key(row[name])}: pull-off "
                "counts as positive here, so take off the sign"
            )
        if unit.endswith("N/m"):
            force = parse_quantity(written, "J/m2") * radius * NANOMETRE
        else:
            force = parse_quantity(written, "N")
        if not FORCE_QUANTITY.low <= force <= FORCE_QUANTITY.high:
            raise ValueError(f"{name}: expected {FORCE_QUANTITY.expects}, found {written}")
        forces.append(force)
    mean, median = forces
    if surface not in surfaces:
        raise ValueError(f"surface: expected {' or '.join(surfaces)}, found {quote_key(surface)}")
    if not re.fullmatch("[1-9][0-9]{0,8}" if "mean" in row else "1", count):
        raise ValueError(
            "count: expected a number of forces beside their mean and median, "
            f"found {quote_key(count)}"
        )
    if median > mean:
        raise ValueError(
            "median: expected at most the mean, as of log-normal forces (or give single forces), "
            f"found {row['median']} beside {row['mean']}"
        )
    return surface, mean, median, int(count), row.get("site", "")
