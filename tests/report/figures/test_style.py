"""The style ignores settings of the user, and endless error bars leave the frame."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from hardcontact.report.figures import style


def test_a_user_s_settings_change_no_figure(monkeypatch):
    monkeypatch.setitem(mpl.rcParams, "axes.facecolor", "black")
    with style.print_style():
        assert mpl.rcParams["axes.facecolor"] == mpl.rcParamsDefault["axes.facecolor"]
        assert mpl.rcParams["font.size"] == style.PRINT_SETTINGS["font.size"]


@pytest.mark.parametrize(
    ("bars", "limits"),  # value, low, high of each bar; None: the limits stay
    [([(2, 1.9, 2.1), (8, 1e-9, 1e19)], (0.2, 80)), ([(2, 1, 4), (8, 5, 20)], None)],
)
def test_endless_error_bars_leave_the_frame(bars, limits):
    axes = Figure().subplots()
    axes.axvline(1.0)  # from 0 to 1 in coordinates of the axes, which are no values
    for x, (value, low, high) in enumerate(bars):
        axes.errorbar([x], [value], [[value - low], [high - value]])
    axes.set_yscale("log")
    old_limits = axes.get_ylim()
    style.end_near_values(axes)
    assert np.allclose(axes.get_ylim(), limits or old_limits)
