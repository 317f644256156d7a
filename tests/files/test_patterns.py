"""The paths of a study differ, and their wildcards are read back."""

import re
from string import Formatter

import pytest

from hardcontact.files.patterns import STORE_KEYS, Patterns, wildcard_constraints

DIGESTS = {kind: f"{number:08x}" for number, kind in enumerate(STORE_KEYS)}
PATTERNS = Patterns("results/a", "results/store", "ruby", DIGESTS)
#: Patterns of files that also belong to another pattern.
SPECIAL_CASES = ("stitched_", "short_", "long_")
INTERMEDIATES = {
    name: pattern
    for name, pattern in vars(PATTERNS).items()
    if "{" in pattern and not name.startswith(SPECIAL_CASES)
}
CONSTRAINTS = wildcard_constraints(["uncd", "polished_uncd", "b.c"])
VALUES = {
    "surface": ["uncd", "polished_uncd", "b.c"],
    "features": ["bumps", "pits", "gaussian"],
    "scan": ["1", "12"],
    "sphere_scan": ["3"],
    "first": ["1", "16"],
    "last": ["15", "27"],
    "shape": ["flat", "sphere-R250um"],
    "realization": ["1"],
    "side": ["short", "long"],
    "probe": ["smooth", "rough", "combined"],
    "radius": ["R250um", "R0.5um"],
    "loading": ["H25GPa-F10uN", "H1e-05GPa-F0.1uN"],
    "range": ["rho5.6nm"],
    "radii": ["R250um", "R5um+R0.5um"],
    "loadings": ["H25GPa-F10uN", "H25GPa-F10uN+H16GPa-F10uN"],
    "ranges": ["rho5.6nm", "rho1.4nm+rho5.6nm"],
    "purpose": ["scales", "sampled", "sets", "exponents"],
    "settings_digest": ["0123abcd", "01234567"],
    "digest": ["0123abcd", "01234567"],
    "sphere_digest": ["0123abcd", "smooth"],
}


def wildcards(pattern):
    return {name for _, name, _, _ in Formatter().parse(pattern) if name}


def expression(pattern):
    """Return the regular expression of the paths that a pattern and its constraints allow."""
    expressions = []
    for text, name, _, _ in Formatter().parse(pattern):
        expressions += [re.escape(text), f"(?P<{name}>{CONSTRAINTS[name]})" if name else ""]
    return re.compile("".join(expressions))


def paths(pattern):
    """Yield wildcards and path, every value of every wildcard once at least."""
    names = wildcards(pattern)
    for turn in range(max(map(len, VALUES.values()))):
        values = {name: VALUES[name][turn % len(VALUES[name])] for name in names}
        yield values, pattern.format(**values)


@pytest.mark.parametrize("name", INTERMEDIATES)
def test_a_path_belongs_to_one_pattern_and_gives_its_wildcards_back(name):
    for values, path in paths(INTERMEDIATES[name]):
        matches = {
            kind: match.groupdict()
            for kind, pattern in INTERMEDIATES.items()
            if (match := expression(pattern).fullmatch(path))
        }
        assert matches == {name: values}


def test_every_wildcard_has_a_constraint():
    names_used = set().union(*map(wildcards, vars(PATTERNS).values()))
    assert names_used == CONSTRAINTS.keys() == VALUES.keys()


def test_intermediates_of_a_surface_are_in_a_folder_of_its_files():
    stored = [path for path in INTERMEDIATES.values() if path.startswith(PATTERNS.store)]
    of_surfaces = [path for path in stored if "{surface}" in path]
    assert of_surfaces and all("{surface}/{digest}/" in path for path in of_surfaces)


def test_wildcards_exclude_other_values():
    for name, value in (
        ("surface", "uncd/study"), ("surface", "bxc"), ("scan", "1a"),
        ("shape", "sphere"), ("loading", "H25GPa"), ("side", "both"),
    ):  # fmt: skip
        assert not re.fullmatch(CONSTRAINTS[name], value), (name, value)
