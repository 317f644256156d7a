"""Fig. 3: forces at the published and at the fitted pair, log-normals published and computed."""

import numpy as np
import pytest
from figure_inputs.adhesion import RANGE, WORK, adhesion, inference
from figure_inputs.forces import PUBLISHED_RANGE, PUBLISHED_WORK
from figure_inputs.published_tables import published_constants, published_pull_off
from figure_rows import select

from hardcontact.figures import fig3

PLASTIC = {"contact_model": "plastic"}


def table(data=None):
    forces = adhesion() if data is None else data
    return fig3.table(forces, inference(), published_constants(), published_pull_off())


def forces_at_pairs(data):
    return fig3._forces_at_pairs(data, inference().sel(PLASTIC), published_constants())


def test_forces_are_taken_at_the_published_range_and_scaled_to_its_work():
    data = adhesion()
    drawn = forces_at_pairs(data)["published"]["uncd"]
    computed = data["pull_off_force"].sel(surface="uncd", rho=PUBLISHED_RANGE, **PLASTIC)
    assert np.sort(drawn) == pytest.approx(np.sort(computed.values.ravel()) * PUBLISHED_WORK)


def test_forces_at_the_fitted_pair_have_the_mean_of_the_inference():
    drawn = forces_at_pairs(adhesion())["fitted"]["uncd"]
    expected = inference()["force_mean"].sel(surface="uncd", pair="fitted", **PLASTIC).item()
    # Between two ranges the logarithms are interpolated linearly; the scatter is that of 216 draws.
    assert drawn.mean() == pytest.approx(expected, rel=0.15)


def test_table_holds_published_and_computed_lognormals_at_both_pairs():
    shape = select(table(), surface="polished_uncd", quantity="lognormal_shape")
    shape = shape.set_index(["origin", "pair"])
    assert shape["value"]["published", ""] == pytest.approx(np.sqrt(2 * np.log(8.8 / 1.75)))
    for pair in ("published", "fitted"):
        row = shape.loc[("computed", pair)]
        assert (row["low"], row["value"], row["high"]) == pytest.approx((0.4, 0.5, 0.6))


def test_logarithmic_histograms_hold_every_force():
    for pair in ("published", "fitted"):
        rows = select(table(), surface="mcd", panel="2", pair=pair)
        widths = rows["force_high"] - rows["force_low"]
        assert (rows["value"] * widths).sum() == pytest.approx(1)


def test_missing_scans_are_left_out():
    data = adhesion()
    data["pull_off_force"][2, 1:] = np.nan
    forces = forces_at_pairs(data)["published"]
    assert np.isfinite(forces["ncd"]).all() and 3 * forces["ncd"].size == forces["mcd"].size


def test_legend_and_panels_say_where_the_forces_stand():
    figure = fig3.draw(adhesion(), inference(), published_constants(), published_pull_off())
    (legend,) = figure.legends
    printed = [text.get_text() for text in legend.get_texts()]
    assert "computed, published ρ = 5.6 nm, $W$ = 46.3 mJ/m²" in printed
    assert f"computed, fitted ρ = {RANGE:.3g} nm, $W$ = {WORK * 1000:.3g} mJ/m²" in printed
    title = figure.axes[len(figure.axes) // 2].get_title(loc="left")
    assert "published $s$ = 1.80\nhere 0.50 [0.40, 0.60]" in title
