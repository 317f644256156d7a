"""Two studies on one store: neither repeats the files of the other or finds them outdated.

Every key but those that the files of a folder of the store depend on has another value at once:
Snakemake then finds these files as they should be. That keys which the paths name have files of
their own by value is tried one by one, or below tests/config.
"""

import csv
from functools import cache

import pytest
import yaml
from repository import (
    PAPER,
    ROOT,
    TINY,
    leaves,
    linked_copy,
    merge_configurations,
    snakemake_output,
)

from hardcontact.config.configuration import get_key, set_keys
from hardcontact.files.patterns import STORE_KEYS

pytestmark = pytest.mark.study

STUDY = merge_configurations(PAPER, yaml.safe_load((ROOT / TINY).read_text()))
STORE = STUDY["store"]
#: Keys without another value here: they name files, or a study that is not the paper's.
FIXED = {
    "study", "store", "surfaces", "published", "forces", "effort", "quick", "sphere.surface"
}  # fmt: skip
#: Keys whose values, or the numbers that they count, are part of paths.
IN_PATHS = {
    "sphere.radius", "contact.preload", "contact.hardness", "adhesion.range",
    "scales.sphere_roughness", "scales.realizations", "sets.pool_size", "sets.count",
    "sets.realizations", "exponents.realizations", "exponents.radii", "scales.whole_surfaces",
}  # fmt: skip
#: Other values of keys that are no numbers.
OTHER_WORDS = {
    "scans": [1], "scan.undefined_pixels": "harmonic", "scan.unit": "nm", "scan.map_size": "5 um",
    "scan.mask": "exclude", "scan.levelling": "lines",
    "reference_surface": "mcd", "indent.surface": "mcd",
    "substitutes.featured_surface": "mcd", "scales.sphere_roughness": True,
}  # fmt: skip
#: The keys of filtered masters by their purpose; a section inherits from those around it.
_OF_SCANS = (*STORE_KEYS["scans"], "contact.window")
FILTERED = {
    "scales": (*_OF_SCANS, "scales.short", "scales.long", "contact.contacts_per_row"),
    "sets": (
        *_OF_SCANS, "scales.short", "scales.long", "sets.short", "sets.long",
        "sets.contacts_per_row"
    ),
    "edge_shifts": (*_OF_SCANS, "scales.short", "sets.short", "sets.contacts_per_row"),
    "exponents": (
        *_OF_SCANS, "scales.short", "scales.long", "sets.short", "sets.long",
        "sets.contacts_per_row"
    ),
}  # fmt: skip
#: Folders whose keys another one has, or of measured surfaces (test_own_reruns.py).
LEFT_OUT = {
    "conditioning", "stitched", "measurements", "measured_spectra",
    "sampled_spectra", "perturbed_scans", "hindcast", "both_bodies",
}  # fmt: skip
FOLDERS = {kind: keys for kind, keys in STORE_KEYS.items() if kind not in LEFT_OUT}
FOLDERS["featured_samples"] += (
    "substitutes.featured_surface",
)  # It names their surface, in the path.
FOLDERS |= {f"filtered/{purpose}": keys for purpose, keys in FILTERED.items()}


def another(key):
    """Return another value of a key: 2 more, a few percent less, one tile fewer, or a word."""
    value = get_key(STUDY, key)
    if key in OTHER_WORDS:
        return OTHER_WORDS[key]
    if key.endswith("tiles"):
        return value - 1
    return [moved(item) for item in value] if isinstance(value, list) else moved(value)


def moved(value):
    if isinstance(value, str):
        number, unit = value.split()
        return f"{0.97 * float(number):.4g} {unit}"
    return value + 2 if isinstance(value, int) else 0.9 * value


def is_part(key, section):
    """Return True if a key equals a name or belongs to the section of this name."""
    return f"{key}.".startswith(f"{section}.")


def second_study(keys):
    """Return the overlay of a study of another name, with other values of some keys."""
    return set_keys({"study": "second"}, {key: another(key) for key in keys})


def summary(folder):
    """Return Snakemake's plan for each existing file of a study in the store."""
    text = snakemake_output(folder, "--detailed-summary", "--configfile", TINY, "overlay.yaml")
    lines = text.splitlines()
    header = next(n for n, line in enumerate(lines) if line.startswith("output_file\t"))
    rows = csv.DictReader(lines[header:], delimiter="\t")
    return {
        row["output_file"]: row["plan"]
        for row in rows
        if row["output_file"].startswith(STORE) and (folder / row["output_file"]).exists()
    }


@pytest.fixture(scope="module")
def plans(finished, tmp_path_factory):
    """Return a function from changed keys to the plans for the store of the finished study."""
    top = tmp_path_factory.mktemp("second")

    @cache  # Some folders have the same keys.
    def planned(keys):
        folder = linked_copy(finished, top / str(len(list(top.iterdir()))))
        (folder / "overlay.yaml").write_text(yaml.safe_dump(second_study(keys)))
        return summary(folder)

    return planned


@pytest.mark.parametrize("folder", FOLDERS)
def test_keys_outside_paths_change_no_file(plans, folder):
    independent_keys = IN_PATHS | FIXED
    other_keys = tuple(
        key
        for key in leaves(STUDY)
        if key not in independent_keys
        and not any(is_part(key, section) for section in FOLDERS[folder])
    )
    planned = plans(other_keys)
    file_plans = {plan for path, plan in planned.items() if path.startswith(f"{STORE}/{folder}/")}
    assert file_plans == {"no update"}


@pytest.mark.parametrize(
    "keys",
    [
        ("scales.sphere_roughness",),
        ("scales.realizations", "exponents.realizations", "sets.pool_size", "sets.realizations"),
    ],
)
def test_values_in_paths_change_no_file(plans, keys):
    assert set(plans(keys).values()) == {"no update"}
