"""Repeated contact: the table holds what is drawn, the image stands at the largest preload."""

from functools import cache

import numpy as np
import pytest
from figure_inputs.published_tables import published_constants
from figure_inputs.repeated_contact import STAGES, repeated_contact
from figure_rows import select
from paper_numbers import LABELS, SUBSTRATES

from hardcontact.figures import fig_repeated_contact, style


@cache
def drawn():
    return fig_repeated_contact.draw(repeated_contact(), published_constants())


def test_table_holds_curves_indents_and_the_image():
    data = repeated_contact()
    rows = fig_repeated_contact.table(data, published_constants())
    for name in ("force_ratio", "depth", "lateral_size"):
        of_name = select(rows, quantity=name, origin="computed")
        assert len(of_name) == 5 * len(STAGES)
        one = select(of_name, surface="ncd", preload=2e-5, stage=400)
        assert one["value"].item() == data[name].values[2, 1, -1]
        assert one["low"].item() == data[f"{name}_interval"].values[2, 1, -1, 0]
    sizes = select(rows, quantity="indent_size")["value"]
    np.testing.assert_array_equal(sizes, data.indent_size.values[2, 1].ravel())
    image = select(rows, origin="published").set_index("quantity")
    assert tuple(image.loc["depth", ["low", "high"]]) == (2, 10)
    assert tuple(image.loc["lateral_size", ["low", "high"]]) == (150, 300)


def test_map_and_indents_are_those_at_the_preload_of_the_image():
    view, sizes = drawn().axes[3:5]
    assert view.get_title(loc="left").endswith("d}$  after 400 contacts on NCD, 20 µN")
    assert view.collections[0].get_array().max() == pytest.approx(9)
    np.testing.assert_array_equal(
        sizes.lines[0].get_xdata(), repeated_contact().indent_size[2, 1].values.ravel()
    )


def test_indents_have_the_colour_of_their_surface():
    assert drawn().axes[4].lines[0].get_color() == style.colours(SUBSTRATES)["ncd"]


def test_curves_of_both_preloads_are_told_apart():
    lines = drawn().axes[1].lines
    shown = [line for line in lines if np.isfinite(np.asarray(line.get_ydata(), float)).all()]
    assert sorted(line.get_linestyle() for line in shown) == ["-"] * 4 + ["--"]


def test_substitutes_are_named():
    (note,) = [text.get_text() for text in drawn().texts]
    assert note.startswith(f"substitute surfaces: {', '.join(LABELS)}")
    assert list(repeated_contact().surface.values) == SUBSTRATES
