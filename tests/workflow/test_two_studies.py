"""Two studies on one store: neither repeats the files of the other or finds them outdated.

Files of a kind of intermediate are made from files of the kinds that its digest covers. So a second
study may differ in all other keys: Snakemake finds the files as they should be.
"""

import csv
from contextlib import chdir

import pytest
import yaml
from repository import dotted_keys, snakemake_outputs
from studies import configured_files

from hardcontact.config.configuration import get_key, numeric_configuration, set_keys
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.settings import intermediate_kinds, settings_digest

pytestmark = pytest.mark.study

#: Keys without another value here: they name files, or a study of another kind.
UNCHANGED_KEYS = {
    "study", "store", "surfaces", "published", "forces", "effort", "quick", "sphere.surface",
    "scans", "given_quantities",
}  # fmt: skip
#: Keys that change which files there are, by numbers or names in paths.
PATH_KEYS = {
    "band.sphere_roughness", "band.masters", "band.whole_surfaces", "sets.pool_size",
    "sets.count", "sets.masters", "exponents.masters", "substitutes.featured_surface",
}  # fmt: skip
#: Values of keys that are no numbers; a key takes the first that it does not have.
OTHER_WORDS = {
    "scan.undefined_pixels": ("harmonic", "refuse"), "scan.unit": ("nm", "none"),
    "scan.map_size": ("5 um", "none"), "scan.mask": ("exclude", "keep"),
    "scan.levelling": ("lines", "plane"), "reference_surface": ("mcd", "uncd"),
    "indent.surface": ("mcd", "uncd"), "substitutes.featured_surface": ("mcd",),
}  # fmt: skip


def other_value(key, value):
    """Return another value of a key: another number, one tile fewer, or another word."""
    if key in OTHER_WORDS:
        return next(word for word in OTHER_WORDS[key] if word != value)
    if key.endswith("tiles"):
        return value - 1
    if isinstance(value, list):
        return [other_number(item) for item in value]
    return other_number(value)


def other_number(value):
    """Return a quantity 3 % less, a number 10 % less, a count 2 more, or the other truth value."""
    if isinstance(value, str):
        number, unit = value.split()
        return f"{0.97 * float(number):.4g} {unit}"
    if isinstance(value, bool):
        return not value
    return value + 2 if isinstance(value, int) else 0.9 * value


def second_study(config, keys):
    """Return the configuration with other values of some keys."""
    return set_keys(config, {key: other_value(key, get_key(config, key)) for key in keys})


def independent_keys(config, selection, kind):
    """Return the keys whose values leave the digest of a kind as it is."""

    def digest(*keys):
        study = numeric_configuration(second_study(config, keys))
        return settings_digest(intermediate_kinds(StudyPlan(study, selection)), kind)

    keys = sorted({*dotted_keys(config)} - UNCHANGED_KEYS - PATH_KEYS)
    return tuple(key for key in keys if digest(key) == digest())


def summarize(folder, config, path):
    """Return the rows of Snakemake's summary of a study, written to a path: a row by output."""
    path.write_text(yaml.safe_dump(config))
    (text,) = snakemake_outputs(folder, [["--detailed-summary", "--configfile", str(path)]])
    lines = text.splitlines()
    header = next(n for n, line in enumerate(lines) if line.startswith("output_file\t"))
    return {row["output_file"]: row for row in csv.DictReader(lines[header:], delimiter="\t")}


def covered_digests(kinds, name):
    """Return the digests of a kind and of all kinds that it is made from."""
    sources = (covered_digests(kinds, source) for source in kinds[name].made_from)
    return {settings_digest(kinds, name)}.union(*sources)


def assert_inputs_are_covered(rows, plan):
    """Expect files of a store to have inputs of the kinds that their digest covers."""
    kinds = intermediate_kinds(plan)
    covered = {settings_digest(kinds, name): covered_digests(kinds, name) for name in kinds}
    checked_digests = set()
    for output, row in rows.items():
        for digest in covered.keys() & {*output.split("/")}:
            inputs = {part for path in row["input-file(s)"].split(",") for part in path.split("/")}
            assert covered.keys() & inputs <= covered[digest], output
            checked_digests.add(digest)
    assert len(checked_digests) > 5


@pytest.mark.parametrize(
    ("fixture", "study", "kind"),
    [("finished", "tiny", "masters"), ("own_study", "several-quick", "octave_forces")],
)
def test_keys_outside_the_digest_change_no_file(request, tmp_path, fixture, study, kind):
    folder = request.getfixturevalue(fixture)
    config = yaml.safe_load((folder / f"results/{study}/configuration.yaml").read_text())
    config |= {"study": "second", "effort": "full", "quick": {}}
    with chdir(folder):
        selection = configured_files(config).selection
    config = second_study(config, independent_keys(config, selection, kind))
    rows = summarize(folder, config, tmp_path / "second.yaml")
    assert_inputs_are_covered(rows, StudyPlan(numeric_configuration(config), selection))
    files = [path for path in rows if f"/{kind}/" in path]
    assert files and all((folder / path).exists() for path in files)
    assert {rows[path]["plan"] for path in files} == {"no update"}


def test_values_in_paths_change_no_file(finished, tmp_path):
    config = yaml.safe_load((finished / "results/tiny/configuration.yaml").read_text())
    rows = summarize(
        finished, second_study(config, PATH_KEYS) | {"study": "second"}, tmp_path / "second.yaml"
    )
    plans = {
        row["plan"]
        for path, row in rows.items()
        if path.startswith(config["store"]) and (finished / path).exists()
    }
    assert plans == {"no update"}
