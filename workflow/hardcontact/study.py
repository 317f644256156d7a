"""The configuration of a study and its table of surfaces: read, converted to numbers, checked.

All faults are ValueErrors of one line: the key or row, what was expected, what was found.
"""

import math
import os
import reprlib
from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

from hardcontact import limits, schema, spectrum
from hardcontact.limits import Grid
from hardcontact.reading import read_scan
from hardcontact.units import magnitude

__all__ = ["check", "configuration", "refuse_repeated_keys", "selected_scans", "surface_table"]

#: The largest table or description of surfaces in bytes: some ten thousand scans.
TABLE_LIMIT = 2**20
#: Models of a band of a description, with the rows of Table 1 that fill in a blank Hurst exponent.
MODELS = {
    "self-affine": spectrum.SELF_AFFINE_ROWS,
    "smooth roll-off": (),
    "profile": (),
    "power law": spectrum.TAIL_ROWS,
}
#: Columns of the points of a profile's spectrum.
POINTS = ("wavelength_nm", "c1d_nm3")
#: Pixel sizes in nm that spectra are known at: tables and bins end at 0.1 nm and 100 um.
PIXEL_SIZES = (0.05, 1e4)


def refuse_repeated_keys(path):
    """Raise ValueError naming a key that a YAML file gives twice, for only the last would count."""
    try:
        pending = [("", yaml.compose(Path(path).read_text("utf-8"), yaml.CSafeLoader))]
    except yaml.YAMLError:  # JSON with tabs
        return
    walked = set()  # an alias is the node that it stands for, which may even hold itself
    while pending:
        above, node = pending.pop()
        if not isinstance(node, yaml.MappingNode) or id(node) in walked:
            continue
        walked.add(id(node))
        keys = set()
        for key, value in node.value:
            name = f"{above}{key.value}"
            if name in keys:
                raise ValueError(
                    f"{path}: line {key.start_mark.line + 1}: expected each key once, "
                    f"found {schema.plain(name)} again"
                )
            keys.add(name)
            pending.append((f"{name}.", value))


def configuration(config, rules):
    """The configuration with every quantity as a number in the unit its schema names.

    Raises ValueError naming the key that is unknown, missing or of the wrong type, unit or size.
    """
    schema.refuse(config, rules, "config key ")
    return _numbers(config, rules, rules)


def _numbers(value, schema, root):
    """The part of a configuration below one place of its schema, quantities as numbers."""
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].rsplit("/", 1)[1]]
    if "unit" in schema:
        return magnitude(value, schema["unit"])
    if isinstance(value, dict):
        return {key: _numbers(item, schema["properties"][key], root) for key, item in value.items()}
    if isinstance(value, list) and "items" in schema:
        return [_numbers(item, schema["items"], root) for item in value]
    return value


def surface_table(path, rules):
    """The table of surfaces, one row a scan, checked for what its rows say of each other.

    rules: schema of a row. The index is the line of the file. Raises ValueError naming the line.
    """
    (_, header), *rows = _cells(path) or [(1, [])]
    if sorted(header) != sorted(rules["required"]) or not rows:
        raise ValueError(
            f"{path}: expected a table of surfaces, the columns {', '.join(rules['required'])}, "
            "separated by tabs, and a row a scan; "
            f"found {schema.plain(', '.join(header))} and {len(rows)} rows"
        )
    for line, cells in rows:
        if len(cells) != len(header):
            raise ValueError(
                f"{path}: line {line}: expected {len(header)} cells, separated by tabs, "
                f"found {len(cells)}"
            )
        schema.refuse(dict(zip(header, cells, strict=True)), rules, f"{path}: line {line}, ")
    lines, cells = zip(*rows, strict=True)
    table = pd.DataFrame(cells, columns=header, index=lines, dtype=str)
    table["scan"] = table["scan"].astype(int)
    _refuse_repeated(path, table, ["surface", "scan"])
    _refuse_repeated(path, table[table.source == "measured"], ["path", "dataset"])
    for surface, rows in table.groupby("surface"):
        columns = ["label", "source"]
        if rows.source.iloc[0] == "substitute":
            columns.append("path")
        for column in columns:
            if rows[column].nunique() > 1:
                raise ValueError(
                    f"{path}: surface {surface}: expected one {column}, "
                    f"found {', '.join(rows[column].unique()[:5])}"
                )
    for row in table.itertuples():
        if not os.path.isfile(row.path):
            raise ValueError(
                f"{path}: line {row.Index}: expected the file {row.path}, found no such file"
            )
    return table


def _cells(path):
    """Number and cells of every line of a table that is not blank."""
    if not os.path.isfile(path):
        raise ValueError(f"config key surfaces: expected a table of surfaces, found no file {path}")
    if os.path.getsize(path) > TABLE_LIMIT:
        raise ValueError(f"{path}: expected at most {TABLE_LIMIT} bytes, found more")
    try:
        lines = Path(path).read_bytes().decode("utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: expected a table of surfaces in UTF-8, found: {error}") from None
    return [(number, line.split("\t")) for number, line in enumerate(lines, 1) if line.strip()]


def _refuse_repeated(path, table, columns):
    repeated = table[table.duplicated(columns)]
    if len(repeated):
        found = " ".join(str(repeated.iloc[0][column]) for column in columns)
        raise ValueError(
            f"{path}: line {repeated.index[0]}: expected each "
            f"{' and '.join(columns)} once, found again {found}"
        )


def selected_scans(table, scans):
    """The rows of the table whose scan number is in `scans`, or all of them.

    Raises ValueError naming a number that no surface has a scan of.
    """
    if scans == "all":
        return table
    known = sorted(set(table.scan))
    if unknown := sorted(set(scans) - set(known)):
        raise ValueError(
            f"config key scans: expected numbers of scans in the table {reprlib.repr(known)}, "
            f"found {reprlib.repr(unknown)}"
        )
    return table[table.scan.isin(scans)]


def check(config, table, published):
    """Refuse what could only fail later: dangling names, unusable scans, cutoffs out of range.

    config: numbers, as `configuration` returns it; table: the selected scans; published: surfaces
    with a published pull-off force. Measured scans are read. Raises ValueError.
    """
    sphere, contact = config["sphere"]["surface"], config["contact"]
    traced = config["adhesion"]["traced_contact"]
    _refuse_dangling(config, table, sphere, traced)
    for section in ("adhesion", "asperities"):
        _refuse_disorder(f"{section}.ranges", config[section]["ranges"])
    for section, side in product(("scales", "robustness"), ("small", "large")):
        _refuse_disorder(f"{section}.{side}.cutoffs", config[section][side]["cutoffs"])
    if config["reference_surface"] not in published:
        raise ValueError(
            "config key reference_surface: expected a surface with a published "
            f"pull-off force ({', '.join(published)}), "
            f"found {config['reference_surface']}"
        )
    if max(traced["contact"]) >= contact["count"]:
        raise ValueError(
            "config key adhesion.traced_contact.contact: expected indices below "
            f"contact.count = {contact['count']}, found {traced['contact']}"
        )
    if config["scan"]["realization_pixels"] < config["scan"]["pixels"]:
        raise ValueError(
            "config key scan.realization_pixels: expected at least scan.pixels = "
            f"{config['scan']['pixels']}, found {config['scan']['realization_pixels']}"
        )
    for section in ("indent", "robustness"):
        _refuse_disorder(f"{section}.preloads", config[section]["preloads"], "N")
    _refuse_disorder("robustness.hardnesses", config["robustness"]["hardnesses"], "Pa")
    for section in ("elastic", "asperities"):
        if config[section]["contacts"] > contact["count"] ** 2:
            raise ValueError(
                f"config key {section}.contacts: expected at most contact.count squared = "
                f"{contact['count'] ** 2}, found {config[section]['contacts']}"
            )
    _check_names(config)
    published_rows = pd.read_csv("resources/paper/table1.csv").groupby("surface").quantity.agg(set)
    for row in table[table.source == "substitute"].drop_duplicates("surface").itertuples():
        _check_description(row.path, published_rows.get(row.surface, set()))
    grids = {
        surface: _grid(config, surface, rows)
        for surface, rows in table.groupby("surface", sort=False)
    }
    if config["sphere"]["radius"] < grids[sphere].size:
        raise ValueError(
            "config key sphere.radius: expected at least the size of its scans "
            f"({grids[sphere].size:.6g} nm), found {config['sphere']['radius']:.6g} nm"
        )
    for surface, grid in grids.items():
        limits.check(config, surface, grid, grids[sphere])


def _check_names(config):
    """Folders that would lie in each other, and values whose names would be the same."""
    folders = (f"results/{config['study']}", config["store"])
    results, store = (Path(os.path.realpath(folder)) for folder in folders)
    if results.is_relative_to(store) or store.is_relative_to(results):
        raise ValueError(
            f"config key store: expected a folder apart from results/{config['study']}, "
            f"found {config['store']}"
        )
    for skewness in config["robustness"]["skewness"]:
        if float(f"{skewness:g}") != skewness:
            raise ValueError(
                f"config key robustness.skewness: expected at most six digits, found {skewness!r}"
            )


def _check_description(path, published):
    """Refuse a description of a substitute that no spectrum can be made from.

    published: rows of Table 1 that the surface has.
    """
    bands = _numbers_of(path, spectrum.PARAMETERS, ("model", "table"))
    for line, band in enumerate(bands.itertuples(), start=2):
        known = list(MODELS)[: 3 if line == 2 else 4]
        if band.model not in known:
            raise ValueError(
                f"{path}: line {line}: expected a model, one of {', '.join(known)}; "
                f"found {schema.plain(band.model)}"
            )
        missing = set(MODELS[band.model]) - published if math.isnan(band.hurst) else ()
        if missing:
            raise ValueError(
                f"{path}: line {line}: expected a Hurst exponent, or of this surface the rows "
                f"{', '.join(sorted(missing))} in resources/paper/table1.csv; found neither"
            )
        if band.model == "profile":
            _numbers_of(Path(path).parent / str(band.table), POINTS)


def _numbers_of(path, numbers, others=()):
    """A small table (CSV) with columns of numbers more than zero, where not blank, and others."""
    try:
        if os.path.getsize(path) > TABLE_LIMIT:
            raise ValueError(f"more than {TABLE_LIMIT} bytes")
        table = pd.read_csv(path, compression=None)[[*numbers, *others]]
        table = table.astype(dict.fromkeys(numbers, float))
        if table.empty or (table[list(numbers)] < 0).any(axis=None):
            raise ValueError("no row, or a number below zero")
    except (KeyError, OSError, ValueError) as error:
        found = " ".join(str(error).split())[:200]
        raise ValueError(
            f"{path}: expected a table, comma-separated, with the columns "
            f"{', '.join([*numbers, *others])} (resources/README.md); found: {found}"
        ) from None
    return table


def _refuse_disorder(key, values, unit="nm"):
    """Quantities that repeat, perhaps written in another unit, or do not ascend."""
    for smaller, larger in pairwise(values):
        if smaller >= larger:
            raise ValueError(
                f"config key {key}: expected ascending values, "
                f"found {larger:.12g} {unit} after {smaller:.12g} {unit}"
            )


def _refuse_dangling(config, table, sphere, traced):
    substrates = [surface for surface in table.surface.unique() if surface != sphere]
    for key, surface, known in (
        ("sphere.surface", sphere, list(table.surface.unique())),
        ("reference_surface", config["reference_surface"], substrates),
        ("adhesion.traced_contact.surface", traced["surface"], substrates),
        ("indent.surface", config["indent"]["surface"], substrates),
    ):
        if surface not in known:
            raise ValueError(
                f"config key {key}: expected one of {', '.join(known)}, "
                f"surfaces of the table, found {surface}"
            )
    for key, surface in (("scan", traced["surface"]), ("sphere_scan", sphere)):
        known = table.scan[table.surface == surface].tolist()
        if traced[key] not in known:
            raise ValueError(
                f"config key adhesion.traced_contact.{key}: expected a scan of "
                f"{surface} {known}, found {traced[key]}"
            )


def _grid(config, surface, rows):
    if rows.source.iloc[0] == "substitute":
        pixels, size = config["scan"]["pixels"], config["scan"]["size"]
        grid, where = Grid(pixels, size / pixels, size), "config key scan.size"
    else:
        grid, where = _measured(config, surface, rows), rows.path.iloc[0]
    least, most = PIXEL_SIZES
    if not least <= grid.pixel <= most:
        raise ValueError(
            f"{where}: expected pixels of {least:g} to {most:g} nm, where spectra are known, "
            f"found {grid.pixel:.6g} nm"
        )
    return grid


def _measured(config, surface, rows):
    grids = []
    for row in rows.itertuples():
        heights, pixel = read_scan(row.path, row.dataset, config["scan"]["undefined_pixels"])
        pixels, relief = heights.shape[0], float(np.ptp(heights))
        if relief == 0:
            raise ValueError(f"{row.path}: expected a rough surface, found constant height")
        grids.append(Grid(pixels, pixel, pixels * pixel, relief))
        first = grids[0]
        if pixels != first.pixels or not math.isclose(pixel, first.pixel, rel_tol=1e-3):
            raise ValueError(
                f"{row.path}: expected, as in the first scan of {surface}, "
                f"{first.pixels} pixels of {first.pixel:.4g} nm; found {pixels} of {pixel:.4g} nm"
            )
    return first._replace(relief=max(grid.relief for grid in grids))
