"""Table 1: published and computed values, and which agree by construction."""

import pytest
from figure_inputs.published_tables import published_table1
from figure_inputs.surfaces import topography
from figure_rows import select

from hardcontact.figures import table1


def test_what_agrees_by_construction_is_marked():
    rows = table1.table(topography(), published_table1())
    marked = rows[rows["by_construction"]]
    assert set(marked["quantity"]) == {"afm_rms_height", "afm_rms_slope", "afm_rms_curvature"}
    assert set(marked["definition"]) == {"", "gradient", "half the Laplacian"}
    drawn = {
        text.get_text() for text in table1.draw(topography(), published_table1()).axes[0].texts
    }
    assert "107.1 ± 12.0" in drawn  # as published
    assert "107 ± 12 †" in drawn


def test_table_holds_published_and_computed_values():
    rows = select(
        table1.table(topography(), published_table1()), surface="ncd", quantity="afm_rms_curvature"
    )
    assert list(rows["origin"]) == ["published", "computed", "computed"]
    assert list(rows["value"]) == pytest.approx([3.9e-2, 3.9e-2, 7.8e-2])
    assert list(rows["uncertainty"]) == pytest.approx([1.1e-2, 3.9e-3, 7.8e-3])


@pytest.mark.parametrize(
    ("value", "uncertainty", "decimals"), [(108, 11, 0), (3.2, 0.04, 2), (0.51, 0.0, 3), (0, 0, 2)]
)
def test_computed_values_keep_two_digits_of_their_uncertainty(value, uncertainty, decimals):
    assert table1._decimals(value, uncertainty) == decimals
