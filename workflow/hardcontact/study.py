"""The configuration of a study and its table of surfaces: read, converted to numbers, checked.

All faults are ValueErrors of one line: the key or row, what was expected, what was found.
"""

import math
from itertools import pairwise, product
from pathlib import Path

import jsonschema
import numpy as np
import pandas as pd

from hardcontact.contact import contact_pixel_count
from hardcontact.reading import read_scan
from hardcontact.units import magnitude

__all__ = ["check", "configuration", "selected_scans", "surface_table"]

#: What a keyword of a schema expects.
EXPECTED = {
    "const": "{}",
    "enum": "one of {}",
    "exclusiveMaximum": "less than {}",
    "exclusiveMinimum": "more than {}",
    "maxItems": "at most {} entries",
    "maximum": "at most {}",
    "minItems": "at least {} entries",
    "minLength": "at least {} characters",
    "minimum": "at least {}",
    "pattern": "text that matches {}",
    "type": "{}",
    "uniqueItems": "each entry once",
}


def configuration(config, schema):
    """The configuration with every quantity as a number in the unit its schema names.

    Raises ValueError naming the key that is unknown, missing or of the wrong type, unit or sign.
    """
    faults = sorted(_validator(schema).iter_errors(config), key=lambda fault: list(fault.path))
    if faults:
        raise ValueError(f"config key {_key(faults[0])}: {_said(faults[0])}")
    return _numbers(config, schema, schema)


def _validator(schema):
    def unit(validator, name, instance, _schema):
        try:
            if magnitude(instance, name) <= 0:
                yield jsonschema.ValidationError(f"expected more than zero, found {instance!r}")
        except ValueError as error:
            yield jsonschema.ValidationError(str(error))

    base = jsonschema.Draft202012Validator
    return jsonschema.validators.extend(base, {"unit": unit})(schema)


def _key(fault):
    return ".".join(str(part) for part in fault.absolute_path) or "(top level)"


def _said(fault):
    if fault.validator == "additionalProperties":
        known = ", ".join(fault.schema["properties"])
        unknown = ", ".join(sorted(set(fault.instance) - set(fault.schema["properties"])))
        return f"expected one of {known}; found {unknown}"
    if fault.validator == "required":
        missing = ", ".join(sorted(set(fault.schema["required"]) - set(fault.instance)))
        return f"expected all of {', '.join(fault.schema['required'])}; found no {missing}"
    if fault.validator == "oneOf":
        return "; or ".join(_said(choice) for choice in fault.context)
    if fault.validator == "type" and "unit" in fault.schema:
        return f"expected a number with a unit of {fault.schema['unit']}, found {fault.instance!r}"
    if fault.validator in EXPECTED:
        expected = EXPECTED[fault.validator].format(fault.validator_value)
        return f"expected {expected}, found {fault.instance!r}"
    return fault.message


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


def surface_table(path, schema):
    """The table of surfaces, one row a scan, checked for what its rows say of each other.

    Raises ValueError naming the row.
    """
    try:
        table = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    except (OSError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"{path}: expected a table of surfaces, found: {reason}") from None
    if set(table.columns) != set(schema["required"]) or table.empty:
        raise ValueError(
            f"{path}: expected the columns {', '.join(schema['required'])}, separated by tabs, and "
            f"a row a scan; found {', '.join(table.columns)} and {len(table)} rows"
        )
    validator = jsonschema.Draft202012Validator(schema)
    for row, record in enumerate(table.to_dict("records"), start=2):
        for fault in validator.iter_errors(record):
            raise ValueError(f"{path}: line {row}, {_key(fault)}: {_said(fault)}")
    table["scan"] = table["scan"].astype(int)
    _refuse_repeated(path, table, ["surface", "scan"])
    _refuse_repeated(path, table[table.source == "measured"], ["path", "dataset"])
    for surface, rows in table.groupby("surface"):
        for column in ("label", "source"):
            if rows[column].nunique() > 1:
                raise ValueError(
                    f"{path}: surface {surface}: expected one {column}, "
                    f"found {', '.join(rows[column].unique())}"
                )
        if rows.source.iloc[0] == "substitute" and rows.path.nunique() > 1:
            raise ValueError(
                f"{path}: surface {surface}: expected one description, "
                f"found {', '.join(rows.path.unique())}"
            )
    for row in table.itertuples():
        if not Path(row.path).is_file():
            raise ValueError(
                f"{path}: line {row.Index + 2}: expected the file {row.path}, found no such file"
            )
    return table


def _refuse_repeated(path, table, columns):
    repeated = table[table.duplicated(columns)]
    if len(repeated):
        found = " ".join(str(repeated.iloc[0][column]) for column in columns)
        raise ValueError(
            f"{path}: line {repeated.index[0] + 2}: expected each "
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
            f"config key scans: expected numbers of scans in the table {known}, found {unknown}"
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
    for surface, rows in table.groupby("surface", sort=False):
        pixels, pixel_size = _geometry(config, surface, rows)
        _check_contact(config, surface, pixels, pixel_size)
        if surface != sphere:
            for section, side in product(("scales", "robustness"), ("small", "large")):
                _check_side(config, section, side, surface, pixels, pixel_size)


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


def _geometry(config, surface, rows):
    """Pixels and pixel size (nm) that all scans of a surface share."""
    if rows.source.iloc[0] == "substitute":
        return config["scan"]["pixels"], config["scan"]["size"] / config["scan"]["pixels"]
    first = None
    for row in rows.itertuples():
        heights, pixel_size = read_scan(row.path, row.dataset, config["scan"]["undefined_pixels"])
        if np.ptp(heights) == 0:
            raise ValueError(f"{row.path}: expected a rough surface, found constant height")
        found = heights.shape[0], pixel_size
        first = first or found
        if found[0] != first[0] or not math.isclose(found[1], first[1], rel_tol=1e-3):
            raise ValueError(
                f"{row.path}: expected, as in the first scan of {surface}, "
                f"{first[0]} pixels of {first[1]:.4g} nm; "
                f"found {found[0]} of {found[1]:.4g} nm"
            )
    return first


def _check_contact(config, surface, pixels, pixel_size):
    contact, radius = config["contact"], config["sphere"]["radius"]
    varied = config["robustness"]
    window = int(contact["window"] / pixel_size)
    available = min(window, 2 * pixels) ** 2
    for key, preload, hardness in (
        ("contact.preload", contact["preload"], contact["hardness"]),
        ("indent.preloads", max(config["indent"]["preloads"]), contact["hardness"]),
        *(("robustness.preloads", load, contact["hardness"]) for load in varied["preloads"]),
        *(("robustness.hardnesses", contact["preload"], hard) for hard in varied["hardnesses"]),
    ):
        needed = contact_pixel_count(preload, hardness, pixel_size)
        if needed > available:
            raise ValueError(
                f"config key {key}: expected a load that {available} pixels of "
                f"{surface} can carry, found one that needs {needed}"
            )
    if contact["count"] > 2 * pixels:
        raise ValueError(
            f"config key contact.count: expected at most the {2 * pixels} pixels along the "
            f"stitched scan of {surface}, found {contact['count']}"
        )
    narrow = int(config["elastic"]["window"] / pixel_size)
    if narrow < 16:
        raise ValueError(
            "config key elastic.window: expected at least 16 pixels of "
            f"{surface} ({16 * pixel_size:.4g} nm), found {config['elastic']['window']:.4g} nm"
        )
    least = min(config["adhesion"]["ranges"] + [config["scales"]["range"]])
    reach = math.sqrt(2 * radius * least)
    if reach < 2 * pixel_size:
        raise ValueError(
            f"config key adhesion.ranges: expected an interaction radius "
            f"sqrt(2 R rho) of two pixels ({2 * pixel_size:.4g} nm) or more on "
            f"{surface}, found {reach:.4g} nm"
        )


def _check_side(config, section, side, surface, pixels, pixel_size):
    """Masters of one side, of the study (section scales) or of robustness."""
    settings, scales = config[section][side], config["scales"][side]
    tiles, key = scales.get("tiles", 1), f"config key {section}.{side}"
    size = 2 * pixels * tiles * pixel_size
    needed = 2 * pixels * tiles
    if settings["pixels"] < needed:
        raise ValueError(
            f"{key}.pixels: expected at least the {needed} of {tiles} x {tiles} stitched scans of "
            f"{surface}, found {settings['pixels']}"
        )
    master = size / settings["pixels"] if side == "small" else pixel_size
    for name, limit in (("transition", pixel_size), ("cutoffs", master)):
        for wavelength in np.atleast_1d(settings.get(name, scales[name])):
            if not 2 * limit < wavelength <= size:
                raise ValueError(
                    f"{key}.{name}: expected on {surface} more than two pixels "
                    f"({2 * limit:.4g} nm) and at most the domain ({size:.6g} nm), "
                    f"found {wavelength:.4g} nm"
                )
