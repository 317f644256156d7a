"""Studies that differ from the paper's study, and their checks."""

from functools import reduce

from paper_numbers import SUBSTRATES
from repository import PAPER, ROWS

from hardcontact.config import checks
from hardcontact.config import selection as surface_table
from hardcontact.config.model import numeric_configuration


def replace_value(config, path, value):
    """Return a configuration with the value at one path (list of keys) replaced."""
    *branch, last_key = path
    copy = section = dict(config)
    for key in branch:
        section[key] = section = dict(section[key])
    section[last_key] = value
    return copy


def numbers(*values):
    """Return the paper's configuration in numbers with other values: key, value, key, value."""
    pairs = zip(values[::2], values[1::2], strict=True)
    config = reduce(
        lambda config, pair: replace_value(config, pair[0].split("."), pair[1]), pairs, PAPER
    )
    return numeric_configuration(config)


def surfaces(text, folder):
    """Read a table of surfaces of this text, with paths relative to the repository's root."""
    path = folder / "surfaces.tsv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return surface_table.surface_table(path)


def check(config, folder, text=ROWS):
    """Check a configuration in numbers with a table of surfaces of this text."""
    table = surface_table.selected_scans(surfaces(text, folder), config["scans"])
    checks.check_study(config, table, SUBSTRATES)


def own_scans(*paths):
    """Return the text of the paper's table with measured scans in place of UNCD's."""
    rows = [row for row in ROWS.splitlines() if not row.startswith("uncd\t")]
    rows += [f"uncd\tUNCD\t{k}\tmeasured\t{path}\t" for k, path in enumerate(paths, start=1)]
    return "\n".join(rows) + "\n"
