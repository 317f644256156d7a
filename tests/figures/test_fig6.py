"""Fig. 6: ratios, changes, sets and critical wavelengths; what lies beyond the last cutoff."""

import numpy as np
import pytest
from figure_inputs.closed_form import closed_form
from figure_inputs.published_tables import published_constants
from figure_inputs.scales import (
    CRITICAL,
    LARGE_CUTOFFS,
    REALIZATIONS,
    SMALL_CUTOFFS,
    band,
    scales,
)
from figure_inputs.sets import SETS, sets
from figure_rows import select

from hardcontact.figures import fig6


def table(data=None, of_sets=None):
    return fig6.table(
        band() if data is None else data,
        scales(),
        sets() if of_sets is None else of_sets,
        closed_form(),
        published_constants(),
    )


def critical(rows, group, side, over):
    of_group = select(rows, quantity="critical_wavelength", group=group, side=side, over=over)
    (row,) = of_group.to_dict("records")
    return row


def test_table_holds_ratios_and_realizations():
    ratios = select(table(), group="ncd", side="small", quantity="ratio")
    assert ratios["over"].value_counts().to_dict() == {
        "realizations": len(SMALL_CUTOFFS),
        "sets": len(SMALL_CUTOFFS) - 1,  # the first of all cutoffs is not one of the sets'
        **{f"realization {k}": len(SMALL_CUTOFFS) for k in range(1, REALIZATIONS + 1)},
    }


def test_the_closed_form_has_a_curve_on_each_side():
    rows = select(table(), quantity="closed_form_ratio", group="ncd")
    by_side = rows.set_index(["side", "cutoff_wavelength"])["value"].to_dict()
    assert by_side == {
        ("small", 20.0): 1.0,
        ("small", 60.0): 1.5,
        ("large", 1000.0): 3.0,
        ("large", 2000.0): 1.2,
    }
    figure = fig6.draw(band(), scales(), sets(), closed_form(), published_constants())
    drawn = [line.get_xydata().tolist() for line in figure.axes[0].lines]
    assert [[20.0, 1.0], [60.0, 1.5]] in drawn


def test_pooled_change_is_the_mean_of_the_absolute_changes():
    rows = select(table(), side="large", quantity="change", over="realizations")
    changes = rows.pivot(index="cutoff_wavelength", columns="group", values="value")
    others = changes.drop(columns="pooled").mean(axis="columns")
    assert np.allclose(changes["pooled"], others) and len(changes) == len(LARGE_CUTOFFS)


def test_critical_wavelengths_have_their_interval_and_the_published_one():
    rows = table()
    pooled = critical(rows, "pooled", "small", "realizations")
    assert [pooled[name] for name in ("low", "value", "high")] == pytest.approx([42, 60, 90])
    published = select(rows, quantity="critical_wavelength", origin="published")
    assert published["value"].tolist() == [43, 1800]


def test_what_lies_beyond_the_last_cutoff_is_no_number():
    data = band()
    interval = data["critical_wavelength_interval"]
    interval.loc[{"side": "small", "group": "mcd", "bound": "high"}] = SMALL_CUTOFFS[-1]
    rows = table(data)
    row = critical(rows, "mcd", "small", "realizations")
    assert row["beyond"] == "high" and np.isnan(row["high"]) and row["value"] == CRITICAL[0, 3]
    never = critical(rows, "polished_uncd", "large", "realizations")
    assert never["beyond"] == "value" and np.isnan(never["value"])


def test_sets_that_never_leave_the_tolerance_open_their_band():
    of_sets = sets()
    at = {"side": "small", "group": "ncd"}
    of_sets["critical_wavelength"].loc[{**at, "set": np.arange(1, 1 + SETS // 5)}] = np.nan
    row = critical(table(of_sets=of_sets), "ncd", "small", "sets")
    assert row["beyond"] == "high" and row["value"] < SMALL_CUTOFFS[-1]


def test_arrows_mark_what_lies_beyond():
    def arrows(data):
        figure = fig6.draw(data, scales(), sets(), closed_form(), published_constants())
        figure.draw_without_rendering()
        lines = [line for axes in figure.axes for line in axes.lines]
        return sum(line.get_marker() in ("<", ">") and line.get_alpha() == 1 for line in lines)

    none = band()
    none["critical_wavelength"][:] = np.nan
    none["critical_wavelength_interval"][:] = np.nan
    assert arrows(band()) == 1 and arrows(none) == none["critical_wavelength"].size


def test_artificial_roughness_is_shaded_on_the_side_where_it_is():
    figure = fig6.draw(band(), scales(), sets(), closed_form(), published_constants())
    for axes, side in zip(figure.axes, ["small", "large"] * 3, strict=True):
        left, right = axes.get_xlim()
        ends = (left, 20.0) if side == "small" else (1000.0, right)
        hatched = [patch for patch in axes.patches if patch.get_hatch()]
        expected = [ends] if ends[0] < ends[1] else []
        found = [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in hatched]
        assert np.allclose(found, expected)
