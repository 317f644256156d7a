"""Measurements of your surfaces, their names, and the wavelengths that none shows."""

import numpy as np
from own_datasets import MEASUREMENTS, SURFACES, spectra

from hardcontact.report.own_surfaces.datasets import (
    drop_padding,
    measurement_name,
    unreliable_wavelengths,
)


def select_first(data):
    """The data of the first surface."""
    return data.sel(surface=SURFACES[0])


def test_wavelengths_beyond_the_scans_are_unreliable():
    assert unreliable_wavelengths(select_first(spectra())) == [(0.0, 55.0), (25_000.0, np.inf)]


def test_a_gap_between_scans_is_unreliable():
    distant_scans = {name: MEASUREMENTS[name] for name in ("fine.spm", "line.txt")}
    assert unreliable_wavelengths(select_first(spectra(scans=distant_scans))) == [
        (0.0, 55.0), (320.0, 800.0), (25_000.0, np.inf),
    ]  # fmt: skip


def test_an_unreliable_scan_closes_no_gap():
    data = select_first(spectra())
    coarse = data["path"].values == "scans/coarse.spm"
    data["reliable"] = data["reliable"].where(~coarse[:, None], 0)
    assert (320.0, 800.0) in unreliable_wavelengths(data)


def test_padding_is_no_measurement():
    twin = spectra(2).sel(surface=SURFACES[1])
    assert twin.sizes["measurement"] == 3
    assert drop_padding(twin)["path"].values.tolist() == ["scans/fine.spm", "scans/coarse.spm"]
    assert unreliable_wavelengths(twin)[-1] == (5000.0, np.inf)


def test_a_measurement_of_a_container_has_both_names():
    data = select_first(spectra()).isel(measurement=0)
    assert measurement_name(data) == "scans/fine.spm"
    assert measurement_name(data.assign(dataset=((), "map-1"))) == "scans/fine.spm: map-1"
