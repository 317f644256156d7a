"""Fig. 4: the table repeats the inference; gaps do not break the figure."""

import numpy as np
import pytest
from figure_inputs.adhesion import WORK, inference
from figure_inputs.contact import contact
from figure_inputs.published_tables import published_constants, published_pull_off
from figure_rows import select
from paper_numbers import MEAN_FORCE

from hardcontact.figures import fig4

PLASTIC = {"contact_model": "plastic"}


def inputs(data=None):
    fitted = inference() if data is None else data
    return contact(), fitted, published_constants(), published_pull_off()


def test_table_holds_the_numbers_of_the_dataset():
    data = inference()
    rows = fig4.table(*inputs(data))
    computed = select(rows, surface="mcd", quantity="mean_force", origin="computed")
    expected = data["mean_force"].sel(surface="mcd", **PLASTIC) * WORK
    assert computed["value"].values == pytest.approx(expected.values)
    assert computed["low"].values == pytest.approx(0.8 * expected.values)
    published = select(rows, surface="mcd", quantity="ratio", origin="published")
    assert published["value"].item() == MEAN_FORCE[3] / MEAN_FORCE[1]
    work = select(rows, quantity="work_of_adhesion").set_index("origin")
    assert work["value"].to_dict() == {"computed": WORK, "published": 0.0463}
    assert work.loc["published", ["low", "high"]].tolist() == pytest.approx([0.0428, 0.0498])
    region = select(rows, quantity="error_region_range")[["low", "high"]]
    assert region.values.tolist() == [[5.1, 5.3]]
    assert len(select(rows, quantity="bootstrap_work_of_adhesion")) == data.sizes["sample"]


def test_reference_surface_has_ratio_one():
    assert fig4._reference(inference().sel(PLASTIC)) == "uncd"


def test_interval_in_the_legend_has_the_confidence_of_the_study():
    (legend,) = fig4.draw(*inputs()).legends
    assert "90 % bootstrap interval" in {text.get_text() for text in legend.get_texts()}


def test_figure_without_an_error_region():
    data = inference()
    for name in ("region_range", "region_work", "range_from_ratios_interval"):
        data[name].loc[PLASTIC] = np.nan
    data["mean_relative_error"] += 0.5
    figure = fig4.draw(*inputs(data))
    figure.draw_without_rendering()
    labels = {label for axes in figure.axes for label in axes.get_legend_handles_labels()[1]}
    assert {"best fit", "published"} <= labels and "error < 0.1" not in labels
