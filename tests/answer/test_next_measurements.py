"""What would narrow an answer: each measurement is named where the answer lacks it, only there."""

import numpy as np
import pytest
from answer_inputs import SURFACES, continued, datasets, edges, fit, force, open_edges, spectra

from hardcontact.adhesion.finite_scan import finite_scan, finite_scan_warning
from hardcontact.answer.next_measurements import next_measurements

RADIUS, RMS_HEIGHT = 250e3, 6.2


def said(**others):
    """All that is proposed, in one text."""
    return " ".join(next_measurements(datasets(**others).of_surface(SURFACES[0])))


def test_the_wavelengths_between_short_edge_and_contact_scans_are_asked_for():
    # The edge is at 37 [29.6, 46.2] nm; scans are reliable from 55 nm, contacts' from 20 nm.
    wide = force().assign(transition=("side", [100.0, 1000.0]))
    text = said(force=wide)
    assert "reliable between 29.6 nm and 55 nm: it tells where the short edge lies." in text
    assert "short edge" not in said()  # roughness below 20 nm alone is artificial
    differs = continued(wide, small=0.25)
    assert "lies, and which of both forces holds." in said(force=differs)


def test_an_edge_that_may_be_shorter_asks_for_shorter_waves():
    wide = force().assign(transition=("side", [100.0, 1000.0]))
    data = edges()
    data["edge_interval"].loc[{"side": "small", "bound": "low"}] = np.nan
    assert "reliable between 37 nm and 55 nm, and below: it" in said(force=wide, edges=data)


def test_a_long_edge_where_no_scan_is_reliable_asks_for_a_larger_map():
    data = edges()
    data["edge_interval"].loc[{"side": "large", "bound": "high"}] = 60e3  # the scans end at 25 µm
    assert "A larger map, or a long line scan" in said(edges=data)


def test_a_map_is_to_be_as_large_as_contacts_need():
    needed = 2 * 2 * np.sqrt(2 * RADIUS * RMS_HEIGHT)  # two draw sizes: 7 µm
    assert needed == pytest.approx(2 * finite_scan(1.0, RMS_HEIGHT, RADIUS).draw_size)
    assert finite_scan_warning(needed, RMS_HEIGHT, RADIUS) == ""
    assert "A map of 7.04 µm or more" in said()
    wide = datasets().topography.assign(scan_size=("surface", [8e3]))
    assert "or more: as large" not in said(topography=wide)
    assert "A larger map" in said(topography=wide, edges=open_edges())
    assert "A larger map" not in said(edges=edges())


def test_pixels_are_to_resolve_the_contact():
    assert "Pixels of 6.32 nm or less: 10 of them" in said()  # 400 nm² on pixels of 10 nm
    assert "Pixels of" not in said(force=force().assign_attrs(contact_area=1000.0))


def test_more_places_are_asked_for_where_intervals_come_from_parts_of_a_scan():
    assert "other places" not in said()
    assert "other places" in said(force=force().assign(conditional=("surface", [1])))


def test_unknown_tips_and_missing_forces_are_named():
    assert "--tip" in said() and "--forces" in said()
    known = spectra()
    known["tip_radius"] = known["tip_radius"].fillna(10.0)
    given = datasets(spectra=known).of_surface(SURFACES[0])._replace(fit=fit())
    text = " ".join(next_measurements(given))
    assert "--tip" not in text and "--forces" not in text
