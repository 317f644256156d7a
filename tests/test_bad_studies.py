"""Studies that are accepted can be computed; those that are not are refused on the command line."""

import os
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from conftest import (
    PAPER,
    PUBLISHED,
    SCHEMAS,
    heights,
    merged,
    run_snakemake,
    scan,
    snakemake,
)
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from hardcontact import adhesion, contact, fourier, patches, spectrum, sphere, study, synthesis
from hardcontact.topography import level, mirror_stitch, subtract_sphere


def lengths(least, most, count):
    """Up to `count` quantities in nm, ascending, and often at the ends of what is allowed."""
    inside = st.floats(least, most) | st.sampled_from([least * 1.0001, most])
    return st.lists(inside, min_size=1, max_size=count).map(
        lambda found: [f"{length:.9g} nm" for length in sorted(set(found))]
    )


@st.composite
def tiny(draw):
    """A study on tiny grids, with values at and about the limits of what is accepted."""

    def pick(*values):
        return draw(st.sampled_from(values))

    pixels, pixel, tiles = pick(16, 17, 21, 32), pick(0.5, 4.883, 20.0, 78.0), pick(1, 2, 3)
    small, large = 2 * pixels * pick(1, 2, 3), 2 * pixels * tiles * pick(1, 2)
    period, domain, count = 2 * pixels * pixel, 2 * pixels * tiles * pixel, pick(1, 2, 3)
    hardness, touching = pick(1, 25, 1000), pick(0.1, 1, 2, 17, pixels, pixels**2)
    load = f"{touching * hardness * pixel**2:.6g} nN"
    cutoffs = {
        "small": draw(lengths(2 * period / small, period, 3)),
        "large": draw(lengths(2 * pixel, domain, 3)),
    }
    return {
        "scan": {
            "pixels": pixels,
            "size": f"{pixels * pixel:.9g} nm",
            "realization_pixels": pick(pixels, pixels + 1, 2 * pixels),
        },
        "sphere": {"radius": f"{max(pixels * pixel, pick(10, 1e4, 2.5e5, 1e9)):.9g} nm"},
        "contact": {
            "count": count,
            "window": f"{period * pick(0.5, 0.99, 1, 2.3):.9g} nm",
            "preload": load,
            "hardness": f"{hardness} GPa",
        },
        "adhesion": {
            "ranges": [pick("0.1 nm", "0.5 nm", "1 nm"), pick("5 nm", "1 um")],
            "traced_contact": {"contact": [0, count - 1]},
        },
        "scales": {
            "range": pick("0.1 nm", "1 nm", "5.6 nm", "5.6 nm", "1 um"),
            "sphere_roughness": pick(True, False),
            "small": {
                "pixels": small,
                "transition": draw(lengths(2 * pixel, period, 1))[0],
                "cutoffs": cutoffs["small"],
            },
            "large": {
                "pixels": large,
                "tiles": tiles,
                "transition": draw(lengths(2 * pixel, domain, 1))[0],
                "cutoffs": cutoffs["large"],
            },
        },
        "elastic": {"contacts": 1, "window": f"{16 * pixel:.9g} nm"},
        "indent": {"preloads": [f"{4 * touching * hardness * pixel**2:.6g} nN"]},
        "asperities": {
            "contacts": 1,
            "share": pick(0.001, 0.5, 0.999),
            "ranges": ["0.1 nm", "9 nm"],
        },
        "robustness": {
            "count": pick(1, 2),
            "preloads": [],
            "hardnesses": [f"{pick(0.7, 2) * hardness} GPa"],
            "small": {"pixels": small, "cutoffs": cutoffs["small"]},
            "large": {"pixels": large, "cutoffs": cutoffs["large"]},
        },
    }


def accepted(overlay):
    """The configuration in numbers, or None if the study is refused."""
    try:
        config = study.configuration(merged(PAPER, overlay), SCHEMAS["config"])
        study.check(
            config, study.surface_table("config/surfaces.tsv", SCHEMAS["surfaces"]), PUBLISHED
        )
    except ValueError:
        return None
    return config


#: About as rough as MCD, and as the ruby.
TABLE, SMOOTH = (
    (
        spectrum.WAVEVECTORS,
        spectrum.self_affine(spectrum.WAVEVECTORS, plateau, rolloff=1500.0, hurst=0.9),
    )
    for plateau in (2e9, 5e4)
)


def prepared(config, rng, table, radius=None):
    """A substitute scan as masters and contacts are made from it; its pixel size (nm)."""
    scan = config["scan"]
    pixel = scan["size"] / scan["pixels"]
    heights = synthesis.substitute_scan(
        rng,
        scan["pixels"],
        pixel,
        scan["realization_pixels"],
        lambda q: spectrum.at(q, *table),
        0,
        0,
    )
    if radius is None:
        return mirror_stitch(level(heights, pixel)), pixel
    heights = synthesis.sphere_scan(rng, heights, pixel, radius)
    return mirror_stitch(subtract_sphere(heights, pixel, radius)), pixel


def check_forces(totals, rho, pixel):
    forces = adhesion.pull_off_force(np.asarray(totals), rho, pixel, 1.0)
    assert np.isfinite(forces).all() and (forces > 0).all()


def check_pair(config, substrate, rough, pixel):
    """Forces at all contacts and ranges, the largest indents, and the asperities of a contact."""
    settings, radius, ranges = config["contact"], config["sphere"]["radius"], config["adhesion"]
    substrate, rough, pixel, _ = sphere.common_pixels(substrate, pixel, rough, pixel)
    positions = sphere.contact_positions(substrate.shape[0], settings["count"])
    window = sphere.window_pixels(settings["window"], pixel)
    touching = partial(contact.contact_pixel_count, hardness=settings["hardness"], pixel_size=pixel)
    geometry = substrate, positions, pixel, radius, window
    for preload in (settings["preload"], *config["indent"]["preloads"]):
        contacts = contact.all_lowest_gaps(*geometry, touching(preload), rough)
        assert all(len(gaps) == touching(preload) for gaps, _ in contacts.values())
    for gaps, offsets in contacts.values():
        assert 0 < patches.indents(gaps, offsets, pixel).depth < np.inf
    contacts = contact.all_lowest_gaps(*geometry, touching(settings["preload"]), rough)
    rhos = ranges["ranges"]
    outside = adhesion.rough_sphere_sums(
        substrate, rough, positions, contacts, pixel, radius, window, rhos
    )
    for k, rho in enumerate(rhos):
        for place, (gaps, _) in contacts.items():
            for count in (1, len(gaps)):
                check_forces(adhesion.rough_total(outside[k][place], gaps, count, rho), rho, pixel)
    gap = contact.gap_map(substrate, positions[[0, 0]], pixel, radius, window, rough)
    for rho in config["asperities"]["ranges"]:
        attraction = np.exp(-(gap - gap.min()) / rho)
        found = patches.asperities(attraction, config["asperities"]["share"], pixel)
        assert np.isfinite(found).all()


def check_masters(config, rng, stitched, rough, pixel, section, side):
    """Forces of one master, filtered at every cutoff, on a smooth and on a rough sphere."""
    scales, settings = config["scales"][side], config["scales"][side] | config[section][side]
    count = config["robustness" if section == "robustness" else "contact"]["count"]
    make = getattr(synthesis, f"{side}_scale_master")
    size = settings["pixels"] if side == "small" else scales["tiles"]
    master, master_pixel = make(rng, stitched, pixel, size, settings["transition"], TABLE)
    probes = [None, rough] if section == "robustness" else [None]
    for cutoff in (None, *settings["cutoffs"]):
        heights, fine = fourier.filtered(master, master_pixel, side, cutoff, settings["pixels"])
        for probe in probes:
            roughness = None
            if probe is not None:
                heights, roughness, fine, _ = sphere.common_pixels(heights, fine, probe, pixel)
            totals = adhesion.plastic_totals(
                heights,
                roughness,
                sphere.contact_positions(heights.shape[0], count),
                fine,
                config["sphere"]["radius"],
                sphere.window_pixels(config["contact"]["window"], fine),
                [
                    contact.contact_pixel_count(
                        config["contact"]["preload"], config["contact"]["hardness"], fine
                    )
                ],
                config["scales"]["range"],
            )
            check_forces(totals, config["scales"]["range"], fine)


def test_what_is_accepted_can_be_computed(at_root):
    seen = []

    @given(tiny())
    @settings(
        max_examples=40,
        deadline=None,
        derandomize=True,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    def compute(overlay):
        config = accepted(overlay)
        seen.append(config is not None)
        assume(config is not None)
        rng = np.random.default_rng(1)
        stitched, pixel = prepared(config, rng, TABLE)
        rough, _ = prepared(config, rng, SMOOTH, config["sphere"]["radius"])
        check_pair(config, stitched, rough, pixel)
        for section, side in product(("scales", "robustness"), ("small", "large")):
            check_masters(config, rng, stitched, rough, pixel, section, side)

    compute()
    assert sum(seen) >= 40 and not all(seen)


# The command line


@pytest.mark.parametrize(
    ("files", "part"),
    [
        ({"bad.yaml": "scan: {pixels: 1000000000}"}, "config key scan.pixels: expected at most"),
        ({"bad.yaml": "scales: {small: {pixels: 8191}}"}, "small.pixels: expected a multiple of 2"),
        ({"bad.yaml": "store: 'results/{scan}'"}, "config key store: expected a path of letters"),
        ({"bad.yaml": "study: store"}, "config key store: expected a folder apart from"),
        ({"bad.yaml": "inference: {confidence: .nan}"}, "confidence: expected a number, found nan"),
        ({"bad.yaml": "seed: 1\n'seed': 2"}, "bad.yaml: line 2: expected each key once"),
        ({"bad.yaml": "5: 6"}, "config key (top level): expected one of study"),
        ({"bad.yaml": "surfaces: bad.tsv"}, "config key surfaces: expected a table of surfaces"),
        ({"bad.yaml": "surfaces: bad.tsv", "bad.tsv": "\xff"}, "bad.tsv: expected a table of"),
        ({"bad.yaml": "[1, 2]"}, "Config file"),
        ({"bad.yaml": "study: !!python/object/apply:os.mkdir [made]"}, "Config file"),
    ],
)
def test_bad_files_are_refused_before_anything_is_made(repository, files, part):
    for name, content in files.items():
        Path(repository, name).write_bytes(content.encode("latin-1"))
    before = sorted(os.listdir(repository))
    run = snakemake(repository, "-n", "--configfile", "bad.yaml")
    said = [line for line in run.stdout.splitlines() if part in line]
    assert run.returncode != 0 and len(said) == 1, run.stdout
    assert said[0].startswith("error: ") or part == "Config file"
    assert "Traceback" not in run.stdout and "rule " not in run.stdout
    for name in files:
        Path(repository, name).unlink()
    assert set(os.listdir(repository)) - set(before) <= {".snakemake"}


#: Odd pixels, cutoffs and transitions at their ends, one scan of one substrate, one contact.
ACCEPTED = {
    "study": "tiny",
    "store": "results/store-tiny",
    "surfaces": "tiny.tsv",
    "scans": "all",
    "scan": {"pixels": 21, "size": "210 nm", "realization_pixels": 43},
    "contact": {"count": 1, "window": "420 nm", "preload": "1 uN"},
    "adhesion": {"ranges": ["0.5 nm", "1 um"], "traced_contact": {"scan": 7, "contact": [0, 0]}},
    "scales": {
        "realizations": 1,
        "sphere_roughness": True,
        "small": {"pixels": 66, "transition": "20.001 nm", "cutoffs": ["20.001 nm"]},
        "large": {"pixels": 198, "tiles": 3, "transition": "1980 nm", "cutoffs": ["1980 nm"]},
    },
    "elastic": {"contacts": 1, "window": "160 nm"},
    "indent": {"surface": "uncd", "preloads": ["1 mN"]},
    "asperities": {"contacts": 1},
    "robustness": {
        "preloads": [],
        "hardnesses": [],
        "skewness": [],
        "count": 1,
        "small": {"pixels": 66, "cutoffs": ["20.001 nm"]},
        "large": {"pixels": 198, "cutoffs": ["1980 nm"]},
    },
}


def test_an_accepted_study_at_the_limits_runs(repository):
    scan(repository / "own.nc", heights(33, 33), (330.0, 330.0))
    (repository / "tiny.tsv").write_text(
        "surface\tlabel\tscan\tsource\tpath\tdataset\n"
        "uncd\tUNCD & <b>\t7\tmeasured\town.nc\t\n"
        "ruby\truby\t1\tsubstitute\tresources/spectra/ruby.csv\t\n"
    )
    for arguments in (["-n"], ["adhesion", "scales"]):
        run = run_snakemake(repository, *arguments, overlays=[ACCEPTED])
        assert run.returncode == 0, run.stdout[-3000:]
    assert {path.name for path in (repository / "results/tiny").glob("*.nc")} == {
        "adhesion.nc", "contact.nc", "scales.nc",
    }  # fmt: skip
