"""The paths of a study: apart from each other, and read back as they were written."""

import re
from itertools import combinations
from string import Formatter

import pytest

from hardcontact.config.patterns import Patterns, wildcard_constraints

PATTERNS = Patterns("results/a", "results/store", "ruby")
INTERMEDIATES = {
    name: pattern
    for name, pattern in vars(PATTERNS).items()
    if "{" in pattern and not name.startswith(("stitched_", "small_", "large_"))
}
CONSTRAINTS = wildcard_constraints(["uncd", "polished_uncd", "b.c"], ["study", "skewness+0.3"])
VALUES = {
    "surface": ["uncd", "polished_uncd", "b.c"],
    "variant": ["study", "skewness+0.3"],
    "scan": ["1", "12"],
    "sphere_scan": ["3"],
    "first": ["1", "16"],
    "last": ["15", "27"],
    "shape": ["flat", "sphere-R250um"],
    "group": ["0", "12"],
    "realization": ["1"],
    "side": ["small", "large"],
    "probe": ["smooth", "rough"],
    "radius": ["R250um", "R0.5um"],
    "load": ["H25GPa-F10uN", "H1e-05GPa-F0.1uN"],
    "range": ["rho5.6nm"],
    "radii": ["R250um", "R5um+R0.5um"],
    "loads": ["H25GPa-F10uN", "H25GPa-F10uN+H16GPa-F10uN"],
    "ranges": ["rho5.6nm", "rho1.4nm+rho5.6nm"],
    "purpose": ["scales", "drawn", "sets", "scaling"],
}


def wildcards(pattern):
    return {name for _, name, _, _ in Formatter().parse(pattern) if name}


def expression(pattern):
    """Return the regular expression of the paths that a pattern and its constraints allow."""
    parts = []
    for text, name, _, _ in Formatter().parse(pattern):
        parts += [re.escape(text), f"(?P<{name}>{CONSTRAINTS[name]})" if name else ""]
    return re.compile("".join(parts))


def paths(pattern):
    """Yield wildcards and path, every value of every wildcard once at least."""
    names = wildcards(pattern)
    for turn in range(max(map(len, VALUES.values()))):
        values = {name: VALUES[name][turn % len(VALUES[name])] for name in names}
        yield values, pattern.format(**values)


@pytest.mark.parametrize("name", INTERMEDIATES)
def test_a_path_gives_its_wildcards_back(name):
    for values, path in paths(INTERMEDIATES[name]):
        assert expression(INTERMEDIATES[name]).fullmatch(path).groupdict() == values


def test_no_path_belongs_to_two_patterns():
    for one, other in combinations(INTERMEDIATES.values(), 2):
        assert not any(expression(other).fullmatch(path) for _, path in paths(one)), (one, other)


def test_every_wildcard_has_a_constraint():
    used = set().union(*map(wildcards, vars(PATTERNS).values()))
    assert used == CONSTRAINTS.keys() == VALUES.keys()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("surface", "uncd/study"), ("surface", "bxc"), ("variant", "other"), ("scan", "1a"),
        ("shape", "sphere"), ("load", "H25GPa"), ("side", "both"),
    ],
)  # fmt: skip
def test_other_values_are_refused(name, value):
    assert not re.fullmatch(CONSTRAINTS[name], value)


def test_stitched_scans_of_both_bodies_are_stitched_scans():
    whole = expression(PATTERNS.stitched)
    substrate = PATTERNS.stitched_substrate.format(surface="uncd", variant="study", scan=1)
    sphere = PATTERNS.stitched_sphere.format(sphere_scan=2, radius="R250um")
    assert whole.fullmatch(substrate)["shape"] == "flat"
    assert sphere == "results/store/stitched/ruby/study/scan-2-sphere-R250um.nc"


@pytest.mark.parametrize("name", INTERMEDIATES)
def test_log_and_benchmark_have_the_wildcards_of_the_output(name):
    pattern = INTERMEDIATES[name]
    log, benchmark = PATTERNS.log("rule", pattern), PATTERNS.benchmark("rule", pattern)
    assert wildcards(log) == wildcards(benchmark) == wildcards(pattern)
    assert log.startswith("results/store/logs/rule/") and log.endswith(".log")
    assert benchmark.startswith("results/store/benchmarks/rule/") and benchmark.endswith(".tsv")


def test_final_files_lie_in_the_folder_of_the_study():
    assert PATTERNS.dataset("band") == "results/a/band.nc"
    assert PATTERNS.result("claims.csv") == "results/a/claims.csv"
    assert PATTERNS.figure("fig1", "pdf") == "results/a/figures/fig1.pdf"
    assert PATTERNS.page("claims") == "results/a/report/claims.html"
    assert PATTERNS.log("infer") == "results/a/logs/infer.log"
    assert PATTERNS.benchmark("infer") == "results/a/benchmarks/infer.tsv"
