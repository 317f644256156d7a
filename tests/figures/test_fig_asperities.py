"""Asperities: median and quartiles, a smooth sphere, the critical wavelength."""

import numpy as np
import pytest
from figure_inputs.building import RADIUS
from figure_inputs.contact import asperities
from figure_inputs.published_tables import published_constants
from figure_inputs.scales import band
from figure_rows import select

from hardcontact.figures import fig_asperities


def table(patches=None, critical=None):
    return fig_asperities.table(
        asperities() if patches is None else patches,
        band() if critical is None else critical,
        published_constants(),
    )


def test_table_holds_median_and_quartiles():
    data, rows = asperities(), table()
    for name in ("largest_share", "two_largest_share", "patches", "extent"):
        of_contacts = data[name].sel(surface="mcd", rho=2.0).values.ravel()
        drawn = select(rows, surface="mcd", quantity=name, rho=2.0)[["low", "value", "high"]]
        assert drawn.values[0] == pytest.approx(np.percentile(of_contacts, [25, 50, 75]))


def test_lengths_are_those_of_a_smooth_sphere():
    rows = table()
    radius = select(rows, quantity="interaction_radius", rho=5.6)["value"].item()
    assert radius == pytest.approx(1673.3, abs=0.1)  # the paper's 1.7 µm
    diameter = select(rows, quantity="smooth_extent", rho=5.6)["value"].item()
    r = np.linspace(0, 20 * radius, 200_001)
    attraction = r * np.exp(-(r**2) / (2 * RADIUS * 5.6))
    assert attraction[r < diameter / 2].sum() / attraction.sum() == pytest.approx(0.9, abs=1e-3)


def test_table_holds_the_critical_wavelength():
    critical = select(table(), quantity="critical_wavelength").set_index("origin")
    pooled = 5000 / 3
    assert critical["value"].to_dict() == {"computed": pooled, "published": 1800.0}
    ends = critical.loc["computed", ["low", "high"]].astype(float)
    assert list(ends) == pytest.approx([0.7 * pooled, 1.5 * pooled])


def test_lengths_are_drawn_in_micrometres_with_the_confidence_of_the_study():
    last = fig_asperities.draw(asperities(), band(), published_constants()).axes[3]
    drawn = {line.get_label(): np.asarray(line.get_ydata()) for line in last.lines}
    assert drawn["published $λ_L$ (d)"][0] == 1.8
    extent = asperities()["extent"].sel(surface="uncd").median(["scan", "contact"]) / 1000
    assert drawn["UNCD"] == pytest.approx(extent.values)
    assert "its 90 % interval (d)" in last.get_legend_handles_labels()[1]


def test_figure_with_gaps():
    patches, critical = asperities(), band()
    for name in ("largest_share", "two_largest_share", "patches", "extent"):
        patches[name][2, :, 1] = np.nan
    for name in ("critical_wavelength", "critical_wavelength_interval"):
        critical[name][:] = np.nan
    fig_asperities.draw(patches, critical, published_constants()).draw_without_rendering()
    curve = select(table(patches, critical), surface="ncd", quantity="patches")
    assert len(curve) == patches.sizes["rho"] and curve["value"].notna().all()
