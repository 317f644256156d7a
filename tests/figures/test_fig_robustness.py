"""Robustness: variants, the study and the paper in four quantities."""

import numpy as np
import pytest
from figure_inputs.adhesion import VARIANTS, WORK, inference, robustness
from figure_inputs.published_tables import published_constants
from figure_inputs.scales import band
from figure_rows import select

from hardcontact.figures import fig_robustness


def others():
    return inference(), band(), published_constants()


def written(axes):
    return [text.get_text() for text in axes.texts]


def test_table_holds_variants_study_and_published():
    data = robustness()
    rows = fig_robustness.table(data, *others())
    known = len(VARIANTS) - 1  # the sphere of Fig. 6 affects neither range nor work
    assert len(rows) == 4 * (len(VARIANTS) + 2) + 2 * known
    assert len(select(rows, quantity="minimum_range")) == known
    assert len(select(rows, quantity="minimum_work")) == known
    work = select(rows, quantity="work_of_adhesion")
    of_variant = data.sel(variant="preload-5uN")
    drawn = select(work, variant="preload-5uN")[["value", "low", "high"]].values[0]
    interval = of_variant["work_of_adhesion_interval"].values
    assert list(drawn) == [of_variant["work_of_adhesion"].item(), *interval]
    assert select(work, label="the study itself")["value"].item() == WORK
    published = select(work, origin="published")[["value", "low", "high"]].values[0]
    assert list(published) == pytest.approx([0.0463, 0.0428, 0.0498])


def test_short_cutoffs_are_told_from_long_ones():
    data = robustness()
    rows = fig_robustness.table(data, *others())
    for side, published, study in (("small", 43.0, 60.0), ("large", 1800.0, 5000 / 3)):
        of_side = select(rows, quantity=f"critical_wavelength_{side}")
        assert select(of_side, origin="published")["value"].item() == published
        assert select(of_side, label="the study itself")["value"].item() == study
        variants = of_side[of_side["variant"].notna()]["value"]
        assert list(variants) == list(data["critical_wavelength"].sel(side=side).values)


def test_other_minima_of_the_error_stand_beside_the_fit():
    data = robustness()
    range_panel, work_panel, *cutoffs = fig_robustness.draw(data, *others()).axes
    size = fig_robustness.MINIMUM["ms"]
    for axes, share in ((range_panel, 0.2), (work_panel, 5.0)):
        small = [line for line in axes.lines if line.get_markersize() == size]
        drawn = {line.get_ydata()[0]: line.get_xdata()[0] for line in small}
        fitted = {
            line.get_ydata()[0]: line.get_xdata()[0]
            for line in axes.lines
            if line.get_marker() == "o" and line not in small
        }
        assert len(drawn) == len(VARIANTS) - 1
        for height, value in drawn.items():
            assert value == pytest.approx(share * fitted[height])
    assert not [line for axes in cutoffs for line in axes.lines if line.get_markersize() == size]


def test_figure_says_what_a_variant_does_not_affect():
    data = robustness()
    data["critical_wavelength"].loc[{"variant": "gaussian", "side": "large"}] = np.nan
    panels = fig_robustness.draw(data, *others()).axes
    expected = [["not affected"], ["not affected"], [], ["never reached"]]
    assert [written(axes) for axes in panels] == expected


def test_rows_are_the_variants_in_their_order():
    data = robustness()
    first = fig_robustness.draw(data, *others()).axes[0]
    assert [text.get_text() for text in first.get_yticklabels()] == [
        f"with {name}" for name in VARIANTS
    ]
    heights = fig_robustness._heights(data)
    steps = dict(zip(list(VARIANTS)[1:], np.diff(heights), strict=True))
    assert steps["preload-20uN"] == 1 and steps["preload-5uN"] > 1
    low, high = first.get_ylim()
    assert low > heights[-1] and high < 0  # the baseline is on top


def test_one_variant_alone_is_drawn():
    figure = fig_robustness.draw(robustness().isel(variant=[0]), *others())
    figure.draw_without_rendering()


@pytest.mark.parametrize(("number", "text"), [(1, "1 realization of"), (3, "3 realizations of")])
def test_legend_says_how_many_realizations_the_variants_have(number, text):
    figure = fig_robustness.draw(robustness().assign_attrs(realizations=number), *others())
    assert text in figure.legends[0].get_texts()[0].get_text()
