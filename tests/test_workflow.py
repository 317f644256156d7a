"""The graph of jobs, and the quick study from end to end."""

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from conftest import QUICK, ROOT, copy_repository, run_snakemake

from hardcontact import adhesion, dataset, sphere

FIGURES = ("fig1", "fig3", "fig4", "fig6", "table1")
SUBSTRATES = ("polished_uncd", "uncd", "ncd", "mcd")


def planned(folder, *overlays, targets=()):
    """What a dry run would make: (rule, output files) of each job."""
    run = run_snakemake(folder, "-n", *targets, overlays=overlays)
    assert run.returncode == 0, run.stdout
    return re.findall(
        r"^(?:local)?rule (\w+):\n(?:    input: .*\n)?    output: (.*)$", run.stdout, re.M
    )


def counts(jobs):
    return Counter(rule for rule, _ in jobs)


# What a change brings about


def test_a_second_run_has_nothing_to_do(finished):
    run = run_snakemake(finished, "-n")
    assert run.returncode == 0
    assert "Nothing to be done" in run.stdout
    assert planned(finished) == []


def test_touching_files_reruns_nothing(finished_copy):
    for part in ("Snakefile", "environment.txt", "config", "resources", "workflow"):
        for path in [finished_copy / part, *(finished_copy / part).rglob("*")]:
            if path.is_file():
                path.touch()
    assert planned(finished_copy) == []


AFTER_SCALES = {
    "aggregate_scales": 1,
    "infer": 1,
    "evaluate_claims": 1,
    "draw_fig3": 1,
    "draw_fig4": 1,
    "draw_fig6": 1,
}


def test_one_more_cutoff(finished):
    cutoffs = ["43 nm", "80 nm", "120 nm", "500 nm"]
    jobs = planned(finished, {"scales": {"small": {"cutoffs": cutoffs}}})
    assert counts(jobs) == {"compute_filtered_pull_off": 2 * len(SUBSTRATES), **AFTER_SCALES}
    filtered = [output for rule, output in jobs if rule == "compute_filtered_pull_off"]
    assert all(output.endswith("small/cutoff-80nm.nc") for output in filtered)


def test_one_more_realization(finished):
    jobs = planned(finished, {"scales": {"realizations": 3}})
    assert counts(jobs) == {
        "synthesize_small_scale_master": len(SUBSTRATES),
        "synthesize_large_scale_master": len(SUBSTRATES),
        "compute_filtered_pull_off": 8 * len(SUBSTRATES),
        **AFTER_SCALES,
    }
    assert all("realization-3" in output for _, output in jobs if "store-quick" in output)


def test_one_more_scan(finished):
    jobs = counts(planned(finished, {"scans": [1, 2, 3]}))
    assert jobs["synthesize_scan"] == jobs["prepare_scan"] == jobs["measure_topography"] == 5
    assert jobs["compute_pull_off"] == len(SUBSTRATES) * (9 - 4)
    computed = {"calibrate_spectrum", "synthesize_small_scale_master", "compute_filtered_pull_off"}
    assert not computed & jobs.keys()


def test_a_figures_code_redraws_that_figure_alone(finished_copy):
    with open(finished_copy / "workflow/hardcontact/figures/fig6.py", "a") as file:
        file.write("# another line\n")
    assert counts(planned(finished_copy)) == {"draw_fig6": 1}


def test_another_preload_and_back(finished_copy):
    preload = {"contact": {"preload": "12 uN"}}
    jobs = planned(finished_copy, preload)
    assert counts(jobs) == {
        "compute_pull_off": 4 * len(SUBSTRATES),
        "compute_filtered_pull_off": 16 * len(SUBSTRATES),
        "aggregate_adhesion": 1,
        "trace_contact": 1,
        **AFTER_SCALES,
    }
    pair = next(output for rule, output in jobs if rule == "compute_pull_off")
    assert "F12uN" in pair
    run = run_snakemake(finished_copy, pair, "results/quick/contact.nc", overlays=[preload])
    assert run.returncode == 0, run.stdout
    assert Path(finished_copy, pair).is_file()
    assert counts(planned(finished_copy)) == {"trace_contact": 1, "draw_fig4": 1}


def test_another_study_shares_intermediates(finished):
    jobs = planned(finished, {"study": "second"})
    assert counts(jobs) == {
        "aggregate_topography": 1,
        "aggregate_adhesion": 1,
        "trace_contact": 1,
        "draw_fig1": 1,
        "draw_table1": 1,
        **AFTER_SCALES,
    }
    assert all("results/second/" in output for _, output in jobs)


def test_undefined_pixels_do_not_touch_substitutes_spectra(finished):
    jobs = counts(planned(finished, {"scan": {"undefined_pixels": "harmonic"}}))
    assert not {"calibrate_spectrum", "synthesize_scan"} & jobs.keys()


@pytest.mark.parametrize(
    ("target", "last", "not_needed"),
    [
        ("topography", "aggregate_topography", "compute_pull_off"),
        ("adhesion", "aggregate_adhesion", "compute_filtered_pull_off"),
        ("scales", "aggregate_scales", "compute_pull_off"),
        ("claims", "evaluate_claims", "draw_fig1"),
        ("figures", "draw_fig6", "evaluate_claims"),
    ],
)
def test_named_target(finished, target, last, not_needed):
    elsewhere = {"study": "elsewhere", "store": "results/elsewhere"}
    jobs = counts(planned(finished, elsewhere, targets=[target]))
    assert jobs[last] == 1 and not jobs[not_needed]


# The quick study's results


@pytest.fixture(scope="module")
def results(finished):
    return finished / "results" / "quick"


#: Variables of the final datasets: unit, then names; "-" where there is no unit.
CONTENT = {
    "topography": {
        "nm": "rms_height rms_height_mean rms_height_std peak_to_valley example_heights "
        "sphere_as_scanned scan_size all_scales_rms_height",
        "1": "rms_gradient rms_profile_slope skewness kurtosis all_scales_rms_gradient",
        "nm-1": "rms_half_laplacian rms_laplacian all_scales_rms_half_laplacian",
        "nm3": "psd_profile psd_profile_mean",
        "nm4": "psd_isotropic psd_isotropic_mean spectrum",
        "rad nm-1": "wavevector",
        "-": "label basis calibrated_to_table1",
    },
    "adhesion": {
        "N": "pull_off_force",
        "nm": "closest_approach penetration rho",
        "1": "contact_pixels window_change",
        "-": "label basis contact_model",
    },
    "contact": {"nm": "gap separation x y", "Pa": "adhesive_pressure", "N": "force"},
    "scales": {
        "N": "pull_off_force unfiltered_pull_off_force",
        "nm": "cutoff_wavelength",
        "1": "ratio",
        "-": "label basis side",
    },
    "inference": {
        "N": "mean_force mean_force_low contact_spread published_mean_force force_mean "
        "force_median lognormal_median published_lognormal_median",
        "nm": "rho rho_fine range_of_adhesion range_of_adhesion_low range_from_ratios "
        "bootstrap_range region_range_low critical_wavelength critical_wavelength_high",
        "J m-2": "work work_of_adhesion work_of_adhesion_high bootstrap_work region_work_high",
        "1": "ratio published_ratio ratio_error mean_relative_error best_error lognormal_shape "
        "censored_fraction scale_ratio scale_ratio_high",
        "-": "label basis undecided",
    },
}


@pytest.mark.parametrize("name", CONTENT)
def test_dataset_holds_its_variables_with_units(results, name):
    found = dataset.read(results / f"{name}.nc")
    for unit, variables in CONTENT[name].items():
        for variable in variables.split():
            assert found[variable].attrs.get("units", "-") == unit, variable
    without = [
        key
        for key, variable in found.variables.items()
        if variable.dtype.kind == "f" and "units" not in variable.attrs
    ]
    assert without == []


@pytest.mark.parametrize("name", CONTENT)
def test_dataset_says_where_it_comes_from(results, name):
    attributes = dataset.read(results / f"{name}.nc").attrs
    for key in ("title", "history", "parameters", "versions", "code_digest", "input_digests"):
        assert attributes[key], key
    assert attributes["Conventions"].startswith("CF-")


@pytest.mark.parametrize("name", ["topography", "adhesion", "scales", "inference"])
def test_substitutes_are_labelled(results, name):
    found = dataset.read(results / f"{name}.nc")
    assert set(found.basis.values) == {"substitute"}
    assert set(SUBSTRATES) <= set(found.surface.values)


def test_every_map_of_the_store_is_labelled(finished):
    store = finished / "results" / "store-quick"
    maps = [
        path for part in ("scans", "stitched", "masters") for path in store.glob(f"{part}/**/*.nc")
    ]
    assert len(maps) == 10 + 10 + 16
    for path in [*maps, *store.glob("substitutes/**/*.nc")]:
        with xr.open_dataset(path) as found:
            assert found.attrs["basis"].startswith("substitute"), path


def test_forces_are_positive_and_complete(results):
    force = dataset.read(results / "adhesion.nc").pull_off_force
    assert np.isfinite(force).all() and (force > 0).all()
    assert force.sizes["contact_y"] == force.sizes["contact_x"] == 6
    rigid, plastic = (force.sel(contact_model=model) for model in ("rigid", "plastic"))
    assert (plastic >= rigid).all()


def test_claims(results):
    claims = pd.read_csv(results / "claims.csv")
    columns = "id section statement published computed low high unit rule verdict basis note"
    assert list(claims.columns) == columns.split()
    known = {"reproduced", "consistent", "not reproduced", "not testable on substitutes"}
    assert set(claims.verdict) <= known
    assert set(claims.basis) == {"substitute scans", "no scan"}
    published = pd.read_csv(ROOT / "resources/paper/claims.csv")
    assert list(claims.id) == list(published.id) and claims.id.is_unique


SIGNATURES = {"pdf": b"%PDF-", "png": b"\x89PNG"}


@pytest.mark.parametrize("name", FIGURES)
def test_figure(results, name):
    for suffix, signature in SIGNATURES.items():
        assert (results / f"figures/{name}.{suffix}").read_bytes().startswith(signature)
    table = pd.read_csv(results / f"figures/{name}.csv")
    assert len(table) and not table.columns.str.contains("Unnamed").any()


def test_nothing_is_left_half_written(finished):
    files = [path for path in (finished / "results").rglob("*") if path.is_file()]
    assert [path for path in files if path.name.startswith(".") or not path.suffix] == []


def test_every_rule_wrote_its_log_and_benchmark(finished):
    for kind, suffix in (("logs", ".log"), ("benchmarks", ".tsv")):
        found = {
            path.relative_to(folder).parts[0].removesuffix(suffix)
            for folder in (finished / "results").glob(f"*/{kind}")
            for path in folder.rglob(f"*{suffix}")
        }
        assert found == set(RULES) - {"extrapolate_spectrum"}, kind


# The same seed, the same values; any number of threads, the same values


def values_of(folder):
    """Bytes of every variable of the scans and spectra in a store."""
    return {
        (path.relative_to(folder).as_posix(), name): variable.values.tobytes()
        for part in ("spectra", "substitutes", "topography")
        for path in folder.glob(f"{part}/**/*.nc")
        for name, variable in dataset.read(path).variables.items()
    }


def test_the_same_seed_gives_the_same_values(finished, tmp_path):
    folder = copy_repository(tmp_path / "again")
    measured = "results/store-quick/topography"
    run = run_snakemake(
        folder, f"{measured}/uncd/scan-1-flat.nc", f"{measured}/ruby/scan-2-sphere-R250um.nc"
    )
    assert run.returncode == 0, run.stdout[-3000:]
    first, again = (values_of(part / "results/store-quick") for part in (finished, folder))
    assert len({path for path, _ in again}) == 6
    assert all(first[key] == values for key, values in again.items())


def test_threads_do_not_change_the_force_sum():
    heights = np.random.default_rng(5).normal(0.0, 10.0, (300, 300))
    positions = sphere.contact_positions(300, 4)
    arguments = (heights, positions, 20.0, 250e3, 600, 5.6)
    one, two = (adhesion.smooth_sphere_sums(*arguments, threads)[0] for threads in (1, 2))
    assert one.tobytes() == two.tobytes()


# The text of the rules


def rules():
    """Text of each rule that runs a script, by name."""
    text = "\n".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
    blocks = re.findall(r"^rule (\w+):\n((?:(?:    .*)?\n)+)", text + "\n", re.M)
    return {name: block for name, block in blocks if "script:" in block}


RULES = rules()


@pytest.mark.parametrize("name", RULES)
def test_rule_has_log_benchmark_code_parameters_and_its_script(name):
    block = RULES[name]
    for directive in ("input", "output", "params", "log", "benchmark", "script"):
        assert re.search(rf"^    {directive}:$", block, re.M), directive
    assert f'code=code("{name}.py")' in block
    assert f'"../scripts/{name}.py"' in block
    assert (ROOT / f"workflow/scripts/{name}.py").is_file()
    assert re.search(r"^        canonical=", block, re.M)


def test_every_script_belongs_to_a_rule():
    assert {path.stem for path in (ROOT / "workflow/scripts").glob("*.py")} == set(RULES)


def test_every_rule_is_a_script_or_a_named_target(finished):
    run = run_snakemake(finished, "--list-rules")
    listed = set(run.stdout.split()) - {"Using"}
    targets = {"all", "topography", "adhesion", "scales", "claims", "figures"}
    assert set(RULES) | targets <= listed


def test_library_knows_nothing_of_snakemake():
    for path in (ROOT / "workflow/hardcontact").rglob("*.py"):
        assert not re.search(r"^\s*(import|from) snakemake", path.read_text(), re.M), path


# Schema, configuration and documentation


def leaves(tree, path=()):
    """Paths of the leaves of nested dicts."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from leaves(value, (*path, key))
        else:
            yield ".".join((*path, key))


def schema_tree(schema):
    if "properties" in schema:
        return {key: schema_tree(value) for key, value in schema["properties"].items()}
    return None


SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text())
KEYS = sorted(leaves(schema_tree(SCHEMA)))


def objects(schema):
    """Every part of a schema that has properties."""
    if "properties" in schema:
        yield schema
        for part in schema["properties"].values():
            yield from objects(part)


def test_schema_and_configuration_have_the_same_keys():
    assert KEYS == sorted(leaves(CONFIG))


def test_every_key_is_required_and_no_other_allowed():
    for part in objects(SCHEMA):
        assert sorted(part["required"]) == sorted(part["properties"])
        assert part["additionalProperties"] is False


def test_the_quick_study_changes_known_keys_only():
    quick = yaml.safe_load((ROOT / QUICK).read_text())
    assert set(leaves(quick)) <= set(KEYS)


@pytest.mark.parametrize("key", KEYS)
def test_key_is_documented(key):
    text = (ROOT / "config/README.md").read_text()
    assert f"`{key}`" in text or f"`{key.rsplit('.', 1)[-1]}`" in text


def test_columns_of_the_table_of_surfaces_are_documented():
    schema = yaml.safe_load((ROOT / "workflow/schemas/surfaces.schema.yaml").read_text())
    columns = (ROOT / "config/surfaces.tsv").read_text().splitlines()[0].split("\t")
    assert columns == list(schema["properties"])
    text = (ROOT / "config/README.md").read_text()
    assert [column for column in columns if f"`{column}`" not in text] == []


def test_finished_study_is_the_repository_as_it_stands(finished):
    """What the fixture ran is what is tested here, not an older copy."""
    for path in ("Snakefile", "workflow/hardcontact/study.py", "config/config.yaml"):
        assert (finished / path).read_bytes() == (ROOT / path).read_bytes()
