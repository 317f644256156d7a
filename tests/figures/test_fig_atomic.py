"""The figure of finer pixels: the table holds what is drawn, open edges have no row or line."""

from functools import cache

import numpy as np
import pytest
import xarray as xr
from figure_rows import select

from hardcontact.figures import fig_atomic

PIXELS, CUTOFFS = [8192, 32768], np.array([5.0, 20.0, 36.0, 80.0])


def around(value):
    value = np.asarray(value)
    return np.stack([0.9 * value, 1.2 * value], axis=-1)


def atomic():
    """Curves on two numbers of pixels; that on the coarse ones has no edge."""
    by_cutoff, nm = ("pixels", "cutoff_wavelength"), {"units": "nm"}
    numbers = {
        "ratio": (by_cutoff, np.array([[1.0, 1.01, 1.04, 1.08], [1.01, 1.02, 1.05, 1.3]])),
        "filtered_over_finest": (by_cutoff, np.array([[1.02, 1.01, 1.0, 0.83], [1.0] * 4])),
        "force_over_finest": (("pixels",), np.array([1.03, 1.0])),
        "edge": (("pixels",), np.array([np.nan, 44.0])),
    }
    return xr.Dataset(
        {name: (dims, value) for name, (dims, value) in numbers.items()}
        | {f"{name}_interval": ((*dims, "bound"), around(value))
           for name, (dims, value) in numbers.items()}
        | {"pixel_size": ("pixels", [0.61, 0.153], nm)},
        {"pixels": PIXELS, "cutoff_wavelength": CUTOFFS, "bound": ["low", "high"]},
        {"rho": 5.6, "scale_tolerance": 0.1, "confidence": 0.95, "transition": 20.0,
         "surface": "uncd", "label": "UNCD", "basis": "substitute"},
    )  # fmt: skip


@cache
def drawn():
    return fig_atomic.draw(atomic())


def test_table_holds_every_number_with_its_interval():
    rows, data = fig_atomic.table(atomic()), atomic()
    assert not rows.duplicated().any() and rows["unit"].notna().all()
    for pixels in PIXELS:
        for cutoff in CUTOFFS:
            at = {"pixels": pixels, "cutoff_wavelength": cutoff}
            for name in ("ratio", "filtered_over_finest"):
                row = select(rows, quantity=name, **at)
                value = data[name].sel(at).item()
                found = row[["value", "low", "high"]].to_numpy(float)
                np.testing.assert_allclose(found, [[value, 0.9 * value, 1.2 * value]])
    assert select(rows, quantity="edge")["pixels"].tolist() == [32768]  # the other one is open
    assert select(rows, quantity="edge")["pixel_size"].tolist() == [0.153]


def test_curves_are_those_of_the_table_in_percent_where_they_are_compared():
    curves, changes = drawn().axes
    for place, line in enumerate(bars.lines[0] for bars in curves.containers):
        np.testing.assert_allclose(line.get_ydata().astype(float), atomic().ratio[place])
    filtered, unfiltered = (bars.lines[0] for bars in changes.containers)
    np.testing.assert_allclose(filtered.get_ydata().astype(float), [2, 1, 0, -17], atol=1e-9)
    assert unfiltered.get_ydata().astype(float) == pytest.approx([3])
    assert unfiltered.get_xdata().astype(float) == pytest.approx([1.22])


def test_numbers_of_pixels_are_told_apart_without_colour_and_named():
    lines = [bars.lines[0] for bars in drawn().axes[0].containers]
    assert len({line.get_marker() for line in lines}) == len(PIXELS)
    labels = [text.get_text() for text in drawn().axes[0].get_legend().get_texts()]
    assert labels == ["8192² pixels of 0.61 nm", "32768² pixels of 0.15 nm"]


def test_a_substitute_is_named_and_a_measured_surface_is_not():
    (note,) = [text.get_text() for text in drawn().texts]
    assert note.startswith("substitute surfaces: UNCD (")
    measured = fig_atomic.draw(atomic().assign_attrs(basis="measured"))
    assert [text.get_text() for text in measured.texts] == ["all surfaces measured"]
