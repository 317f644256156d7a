"""Fig. 4: the table repeats inference and sets; gaps do not break the figure."""

import numpy as np
import pytest
from figure_inputs.adhesion import MINIMA, RANGE, WORK, inference
from figure_inputs.contact import contact
from figure_inputs.forces import PUBLISHED_WORK
from figure_inputs.published_tables import published_constants, published_pull_off
from figure_inputs.sets import SETS, sets
from figure_rows import select
from paper_numbers import MEAN_FORCE

from hardcontact.figures import fig4

PLASTIC = {"contact_model": "plastic"}


def inputs(data=None):
    fitted = inference() if data is None else data
    return contact(), fitted, sets(), published_constants(), published_pull_off()


def test_forces_are_those_at_the_published_work():
    data = inference()
    rows = select(fig4.table(*inputs(data)), surface="mcd", quantity="mean_force")
    computed = select(rows, origin="computed", over="scans")
    expected = data["mean_force"].sel(surface="mcd", **PLASTIC) * PUBLISHED_WORK
    assert computed["value"].values == pytest.approx(expected.values)
    assert computed["low"].values == pytest.approx(0.8 * expected.values)
    assert select(rows, origin="published")["value"].item() == MEAN_FORCE[3]


def test_forces_at_the_fit_stand_beside_them():
    data = inference()
    rows = select(fig4.table(*inputs(data)), surface="ncd", quantity="mean_force_at_fit")
    expected = data["force_mean"].sel(surface="ncd", pair="fitted", **PLASTIC).item()
    assert rows[["x", "value"]].values.tolist() == [[RANGE, expected]]


def test_band_holds_nine_of_ten_sets():
    rows = select(fig4.table(*inputs()), surface="ncd", quantity="ratio", over="sets")
    ratios = sets()["ratio"].sel(surface="ncd", **PLASTIC)
    inside = (ratios >= rows["low"].values) & (ratios <= rows["high"].values)
    assert (abs(inside.mean("set") - 0.9) <= 0.011).all()


def test_table_holds_the_fit_and_its_minima():
    data = inference()
    rows = fig4.table(*inputs(data))
    published = select(rows, surface="mcd", quantity="ratio", origin="published")
    assert published["value"].item() == MEAN_FORCE[3] / MEAN_FORCE[1]
    work = select(rows, quantity="work_of_adhesion").set_index("origin")
    assert work["value"].to_dict() == {"computed": WORK, "published": 0.0463}
    assert work.loc["published", ["low", "high"]].tolist() == pytest.approx([0.0428, 0.0498])
    assert len(select(rows, quantity="sampled_work")) == data.sizes["sample"]
    assert len(select(rows, quantity="best_error_of_set")) == SETS
    minima = select(rows, quantity="minimum_range")["value"]
    assert minima.tolist() == MINIMA[1, 0, :2].tolist()


def test_reference_surface_has_ratio_one():
    assert fig4._reference(inference().sel(PLASTIC)) == "uncd"


def test_every_panel_with_a_range_marks_the_published_one():
    figure = fig4.draw(*inputs())
    panels = [axes for axes in figure.axes if axes.get_xlabel() == "range of adhesion ρ (nm)"]
    for axes in panels:
        vertical = [line.get_xdata() for line in axes.lines if len(set(line.get_xdata())) == 1]
        assert any(list(ends) == [5.6, 5.6] for ends in vertical)
    assert len(panels) == 4


def test_legend_says_which_interval_and_which_range():
    legends = [axes.get_legend() for axes in fig4.draw(*inputs()).axes]
    printed = [text.get_text() for legend in legends if legend for text in legend.get_texts()]
    assert {
        "90 % interval over scans (bars)",
        "90 % of all sets of substitutes",
        "published range, ρ = 5.6 nm",
    } <= set(printed)


def test_figure_without_an_error_region():
    data = inference()
    for name in ("region_range", "region_work", "range_from_ratios_interval"):
        data[name].loc[PLASTIC] = np.nan
    data["mean_relative_error"] += 0.5
    figure = fig4.draw(*inputs(data))
    figure.draw_without_rendering()
    labels = {label for axes in figure.axes for label in axes.get_legend_handles_labels()[1]}
    assert {"best fit of the study", "published fit"} <= labels and "error < 0.1" not in labels


def test_figure_of_a_fit_at_the_end_of_the_sweep_without_intervals():
    data = inference()
    data["range_of_adhesion"].loc[PLASTIC] = 40.0
    for name in data:
        if str(name).startswith(("minimum_", "sampled_")) or str(name).endswith("_interval"):
            data[name][:] = np.nan
    fig4.draw(*inputs(data)).draw_without_rendering()
    assert select(fig4.table(*inputs(data)), quantity="minimum_range").empty


def test_the_interval_of_the_least_error_is_said_to_be_over_scans():
    data = inference()
    assert title_of_errors(data).endswith("] over scans")
    data["best_error_interval"][...] = np.nan
    assert title_of_errors(data).endswith("smallest error 0.056")


def title_of_errors(data):
    """The title of panel d."""
    titles = [axes.get_title("left") for axes in fig4.draw(*inputs(data)).axes]
    return next(title for title in titles if "smallest error" in title)
