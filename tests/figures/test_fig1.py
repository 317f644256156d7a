"""Fig. 1: the table repeats the maps that are drawn."""

import pytest
from figure_inputs.surfaces import topography
from figure_rows import select

from hardcontact.figures import fig1


def test_table_holds_the_rms_height_of_each_map():
    data = topography()
    rows = fig1.table(data)
    drawn = select(rows, surface="mcd", quantity="map_rms_height")["value"].item()
    assert drawn == pytest.approx(107.1)
    over_scans = select(rows, surface="uncd", quantity="rms_height_mean")
    assert over_scans["value"].item() == data["rms_height_mean"].sel(surface="uncd").item()
    assert list(select(rows, surface="ruby", quantity="map_rms_height")["panel"]) == ["e", "f"]


def test_padding_of_smaller_scans_is_not_drawn():
    data = topography()
    data["example_heights"][0, 20:], data["example_heights"][0, :, 20:] = float("nan"), float("nan")
    image = fig1.draw(data).axes[0].images[0].get_array()
    assert image.shape == (20, 20) and not image.mask.any()


@pytest.mark.parametrize(("size", "printed"), [(2500, "500 nm"), (40000, "10 µm"), (90, "20 nm")])
def test_scale_bar_has_a_round_length(size, printed):
    figure = fig1.draw(topography().assign(scan_size=("surface", [size] * 5)))
    assert figure.axes[0].texts[0].get_text() == printed


def test_titles_mark_what_holds_by_construction():
    titles = [axes.get_title(loc="left") for axes in fig1.draw(topography()).axes[:6]]
    assert titles[3].endswith("rms 107 nm (all: 107 ± 12†)")
    assert "†" not in titles[4] + titles[5]
