"""Two studies on one store: neither repeats the files of the other or finds them outdated.

A second study differs in all keys that leave the digest of a kind of intermediate as it is:
Snakemake then finds the files of this kind as they should be.
"""

import csv
from contextlib import chdir
from functools import cache

import pytest
import yaml
from repository import dotted_keys, snakemake_outputs
from studies import configured_files

from hardcontact.config.configuration import get_key, numeric_configuration, set_keys
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.settings import settings_digest, store_kinds

pytestmark = pytest.mark.study

#: Keys without another value here: they name files, or a study of another kind.
UNCHANGED_KEYS = {
    "study", "store", "surfaces", "published", "forces", "effort", "quick", "sphere.surface",
    "scans", "given_quantities",
}  # fmt: skip
#: Keys that change which files there are, by numbers or names in paths.
PATH_KEYS = {
    "scales.sphere_roughness", "scales.realizations", "scales.whole_surfaces", "sets.pool_size",
    "sets.count", "sets.realizations", "exponents.realizations", "substitutes.featured_surface",
}  # fmt: skip
#: Values of keys that are no numbers; a key takes the first that it does not have.
OTHER_WORDS = {
    "scan.undefined_pixels": ("harmonic", "refuse"), "scan.unit": ("nm", "none"),
    "scan.map_size": ("5 um", "none"), "scan.mask": ("exclude", "keep"),
    "scan.levelling": ("lines", "plane"), "reference_surface": ("mcd", "uncd"),
    "indent.surface": ("mcd", "uncd"), "substitutes.featured_surface": ("mcd",),
}  # fmt: skip
#: By the fixture of a finished study: its name, and the kinds of intermediates in its store, one of
#: each rule.
STUDIES = {
    "finished": ("tiny", [
        "scans", "pull_off", "elastic", "asperities", "whole_surfaces", "pool",
        "featured_candidates", "masters", "filtered/band",
    ]),
    "own_study": ("several-quick", [
        "measurements", "measured_spectra", "sampled_spectra", "scans", "both_bodies",
        "octave_forces", "hindcast", "filtered/sampled",
    ]),
}  # fmt: skip


def other_value(key, value):
    """Return another value of a key: 2 more, a few percent less, one tile fewer, or a word."""
    if key in OTHER_WORDS:
        return next(word for word in OTHER_WORDS[key] if word != value)
    if key.endswith("tiles"):
        return value - 1
    if isinstance(value, list):
        return [other_number(item) for item in value]
    return other_number(value)


def other_number(value):
    """Return another quantity, truth value or number."""
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
        return settings_digest(store_kinds(StudyPlan(study, selection)), kind)

    keys = sorted({*dotted_keys(config)} - UNCHANGED_KEYS - PATH_KEYS)
    return tuple(key for key in keys if digest(key) == digest())


@pytest.fixture(scope="module")
def plans(request, tmp_path_factory):
    """Return a function from a fixture to Snakemake's plans for the files of its store.

    Each kind has the plan of a second study in which all keys outside the digest of the kind have
    other values; the plan PATH_KEYS has other values of these keys.
    """

    @cache
    def planned(fixture):
        study, kinds = STUDIES[fixture]
        folder = request.getfixturevalue(fixture)
        config = yaml.safe_load((folder / f"results/{study}/configuration.yaml").read_text())
        config |= {"study": "second", "effort": "full", "quick": {}}
        with chdir(folder):
            selection = configured_files(config).selection
        keys = {
            kind: independent_keys(config, selection, kind.rpartition("/")[2]) for kind in kinds
        }
        if fixture == "finished":
            keys["PATH_KEYS"] = PATH_KEYS
        overlays = tmp_path_factory.mktemp(fixture)
        runs = []
        for number, changed_keys in enumerate(keys.values()):
            overlay = overlays / f"{number}.yaml"
            overlay.write_text(yaml.safe_dump(second_study(config, changed_keys)))
            runs.append(["--detailed-summary", "--configfile", str(overlay)])
        texts = snakemake_outputs(folder, runs)
        plans_of_runs = [plans_of_store(text, folder, config["store"]) for text in texts]
        return dict(zip(keys, plans_of_runs, strict=True))

    return planned


def plans_of_store(text, folder, store):
    """Return the plan of each existing file of a store, by its path there, from a summary."""
    lines = text.splitlines()
    header = next(n for n, line in enumerate(lines) if line.startswith("output_file\t"))
    return {
        row["output_file"].removeprefix(f"{store}/"): row["plan"]
        for row in csv.DictReader(lines[header:], delimiter="\t")
        if row["output_file"].startswith(store) and (folder / row["output_file"]).exists()
    }


@pytest.mark.parametrize(
    ("fixture", "kind"), [(fixture, kind) for fixture in STUDIES for kind in STUDIES[fixture][1]]
)
def test_keys_outside_the_digest_change_no_file(plans, fixture, kind):
    planned = plans(fixture)[kind]
    assert {plan for path, plan in planned.items() if path.startswith(f"{kind}/")} == {"no update"}


def test_values_in_paths_change_no_file(plans):
    assert {*plans("finished")["PATH_KEYS"].values()} == {"no update"}
