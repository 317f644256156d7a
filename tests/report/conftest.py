"""Figures are drawn in the style of print, as `drawing.draw_figure` draws them."""

import pytest

from hardcontact.report.figures import style


@pytest.fixture(autouse=True)
def print_style():
    """Draw every figure of a test in the style of print."""
    with style.print_style():
        yield
