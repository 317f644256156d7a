"""Fig. 6: ratios, realizations and critical wavelengths."""

import numpy as np
from figure_inputs.adhesion import REALIZATIONS, SMALL_CUTOFFS, band, scales
from figure_inputs.published_tables import published_constants
from figure_rows import select

from hardcontact.figures import fig6


def test_table_holds_ratios_realizations_and_critical_wavelengths():
    rows = fig6.table(band(), scales(), published_constants())
    ratios = select(rows, group="ncd", side="small", quantity="ratio")
    assert len(ratios) == len(SMALL_CUTOFFS) * (1 + REALIZATIONS)
    critical = select(rows, group="pooled", side="small", quantity="critical_wavelength")
    assert critical.set_index("origin")["value"].to_dict() == {"published": 43.0, "computed": 60.0}
    ends = critical.set_index("origin").loc["computed", ["low", "high"]]
    assert np.allclose(ends.astype(float), [42, 90])
    never = select(rows, group="polished_uncd", side="large", quantity="critical_wavelength")
    assert never["value"].isna().all()


def test_figure_says_which_ratio_never_leaves_the_band():
    def sentences(data):
        figure = fig6.draw(data, scales(), published_constants())
        figure.draw_without_rendering()
        return sum(len(axes.texts) for axes in figure.axes)

    none = band().map(lambda values: values)
    none["critical_wavelength"][:] = np.nan
    none["critical_wavelength_interval"][:] = np.nan
    assert sentences(band()) == 1 and sentences(none) == none["critical_wavelength"].size
