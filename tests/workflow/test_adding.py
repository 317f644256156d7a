"""A claim, a figure and a key are added as in workflow/README.md, and computed."""

import pandas as pd
import xarray as xr
import yaml
from repository import TINY, snakemake

CLAIM = (
    "largest_force_uncd,,Results,The largest force on UNCD exceeds 1 nN.,largest force,"
    "1e-9,1e-9,,N,above,assumed,adhesion,largest_force,surface=uncd;contact_model=plastic,,,,\n"
)
QUANTITY = '''

def largest_force(adhesion: xr.Dataset) -> xr.Dataset:
    """Return the largest force in N at 1 J/m² (surface, contact_model)."""
    forces = adhesion["pull_off_force"]
    return as_estimate(forces.max(set(forces.dims) - {"surface", "contact_model"}))
'''
FIGURE = '''"""Ranges of adhesion."""

import xarray as xr
from matplotlib.figure import Figure


def draw(fit: xr.Dataset) -> Figure:
    """Draw the range of adhesion of each contact model."""
    figure = Figure()
    figure.subplots().bar(fit["contact_model"], fit["range_of_adhesion"])
    return figure
'''
LISTED_FIGURE = """  fig_mine:
    title: Fits
    chapter: 3. Adhesion
    inputs: [fit]
    caption: Range of adhesion. Drawn from fit.nc.
"""
KEY = '''    percentile: Fraction = 0.9
    """Percentile of depths."""
'''
PASSED_KEY = '            percentile=STUDY["indent"]["percentile"],\n'


def insert(path, anchor, text):
    """Insert a text into a file, after the first occurrence of another."""
    head, separator, tail = path.read_text("utf-8").partition(anchor)
    assert separator, f"{path}: {anchor}"
    path.write_text(head + separator + text + tail, "utf-8")


def test_a_claim_a_figure_and_a_key_are_added_in_two_files_each(finished_copy):
    library = finished_copy / "workflow/hardcontact"
    with open(finished_copy / "resources/paper/claims.csv", "a", encoding="utf-8") as file:
        file.write(CLAIM)
    quantities = library / "paper/force_quantities.py"
    text = quantities.read_text("utf-8")
    listed = f"{QUANTITY}\n\nQUANTITIES = (\n    largest_force,\n"
    quantities.write_text(text.replace("QUANTITIES = (\n", listed), "utf-8")
    (library / "report/figures/fig_mine.py").write_text(FIGURE, "utf-8")
    insert(finished_copy / "workflow/report/figures.yaml", "\npaper:\n", LISTED_FIGURE)
    insert(library / "config/keys.py", '"""Indents."""\n\n', KEY)
    rules = finished_copy / "workflow/rules/plasticity.smk"
    insert(rules, 'preloads=STUDY["indent"]["preloads"],\n', PASSED_KEY)
    overlay = finished_copy / "mine.yaml"
    overlay.write_text(yaml.safe_dump({"indent": {"percentile": 0.8}}), "utf-8")
    results = finished_copy / "results/tiny"

    run = snakemake(finished_copy, "claims", "fig_mine", "--configfile", TINY, str(overlay))

    assert run.returncode == 0, run.stdout[-3000:]
    claims = pd.read_csv(results / "claims.csv").set_index("id")
    assert claims.loc["largest_force_uncd", "computed"] > 1e-9
    assert "Fits" in (results / "figures/fig_mine.svg").read_text()
    with xr.open_dataset(results / "indent.nc") as indent:
        assert '"percentile":0.8' in indent.attrs["parameters"]
