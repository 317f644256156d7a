"""The schema, the configuration and their documentation say the same."""

import pytest
import yaml
from repository import PAPER, QUICK, ROOT, ROWS, SCHEMAS, leaves

from hardcontact.config.key_tables import documented
from hardcontact.config.schema import resolved

SCHEMA = SCHEMAS["config"]


def tree(schema):
    """Return nested dicts with the schema of every key, without references."""
    schema = resolved(schema, SCHEMA)
    if "properties" in schema:
        return {key: tree(part) for key, part in schema["properties"].items()}
    return (schema,)


def groups(schema):
    """Give every part of a schema that has properties."""
    schema = resolved(schema, SCHEMA)
    if "properties" in schema:
        yield schema
        for part in schema["properties"].values():
            yield from groups(part)


def at(config, key):
    for name in key.split("."):
        config = config[name]
    return config


KEYS = sorted(leaves(tree(SCHEMA)))


def test_schema_and_configuration_have_the_same_keys():
    assert KEYS == sorted(leaves(PAPER))


def test_every_key_is_required_and_no_other_allowed():
    for group in groups(SCHEMA):
        assert sorted(group["required"]) == sorted(group["properties"])
        assert group["additionalProperties"] is False


def test_every_key_says_what_it_means_and_what_it_recomputes():
    for key in KEYS:
        (schema,) = at(tree(SCHEMA), key)
        assert schema["description"].strip() and schema["recomputes"].strip(), key
        assert ("unit" in schema) == ("between" in schema), key
        assert "pattern" not in schema or schema["expects"].strip(), key


def test_defaults_are_those_of_the_configuration():
    for key in KEYS:
        (schema,) = at(tree(SCHEMA), key)
        default, value = schema["default"], at(PAPER, key)
        assert (type(default), default) == (type(value), value), key


def test_columns_of_the_table_of_surfaces_are_those_of_the_schema():
    columns, schema = ROWS.splitlines()[0].split("\t"), SCHEMAS["surfaces"]
    assert columns == schema["required"]
    assert [*columns, "use", "tip_radius"] == list(schema["properties"])
    assert all(part["description"] for part in SCHEMAS["surfaces"]["properties"].values())


def test_the_quick_study_changes_known_keys_only():
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    assert set(leaves(quick)) <= set(KEYS)


# The documentation

DOCUMENTATION = (ROOT / "config/README.md").read_text("utf-8")


def test_every_key_and_column_has_a_row():
    for name in [*KEYS, *ROWS.splitlines()[0].split("\t")]:
        assert f"\n| `{name}` |" in DOCUMENTATION, name


def test_the_tables_are_those_of_the_schema():
    current = documented(DOCUMENTATION, SCHEMA, SCHEMAS["surfaces"])
    assert DOCUMENTATION == current, "not current: run python -m hardcontact.config.key_tables"


EMPTY = """a
<!-- keys: begin -->
<!-- keys: end -->
b
<!-- columns: begin -->
<!-- columns: end -->
"""


def test_tables_stand_between_their_markers():
    text = documented(EMPTY, SCHEMA, SCHEMAS["surfaces"])
    assert text.startswith("a\n<!-- keys: begin -->\n")
    assert "\n<!-- keys: end -->\nb\n<!-- columns: begin -->\n" in text
    assert documented(text, SCHEMA, SCHEMAS["surfaces"]) == text
    assert [key for key in KEYS if f"| `{key}` |" not in text] == []


@pytest.mark.parametrize(
    ("key", "parts"),
    [
        ("contact.hardness", ["1000 to 1e+13 Pa", "`25 GPa`", "Intrinsic Work of Adhesion"]),
        ("scales.small.pixels", ["32 to 32768, a multiple of 2", "`8192`"]),
        ("scales.small.cutoffs", ["a list: 0.01 to 1e+09 nm", "14 values, `5 nm` to `2500 nm`"]),
        ("scales.sphere_roughness", ["`true` or `false`", "`false`"]),
        ("indent.preloads", ["a list: 1e-12 to 1 N", "`[10 uN, 20 uN]`"]),
        ("scans", ["`all` or a list: 1 to 9999", "`all`"]),
        ("reference_surface", ["id of a surface", "`uncd`", "Fig. 4b"]),
        ("topography.slope", ["`gradient` or `profile`"]),
        ("robustness.heights.skewness", ["a list: -1 to 1", "`[-1, -0.5, 0.5, 1]`"]),
    ],
)
def test_a_row_names_values_with_their_unit_and_the_default(key, parts):
    text = documented(EMPTY, SCHEMA, SCHEMAS["surfaces"])
    (row,) = (line for line in text.splitlines() if line.startswith(f"| `{key}` |"))
    cells = row.strip("| ").split(" | ")
    assert set(parts) <= set(cells), row
