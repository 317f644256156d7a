"""The scatter of forces on four surfaces and on the designed ones, as the study writes it."""

from functools import cache

import numpy as np
import pandas as pd
import xarray as xr
from known_spectra import rough
from paper_numbers import LABELS, SUBSTRATES

from figure_inputs.building import bounded
from figure_inputs.published_tables import published_pull_off
from hardcontact.contact.contact import contact_of_area
from hardcontact.insight.pull_off_statistics import force_scatter, with_comparison
from hardcontact.records.code import LIBRARY

RMS = [3.0, 6.0, 12.0, 24.0]  # nm, of the substrates


def statistics() -> xr.Dataset:
    """Return the law at one range of adhesion."""
    return _computed().copy(deep=True)


@cache
def _computed() -> xr.Dataset:
    spectra = {name: rough(rms) for name, rms in zip(SUBSTRATES, RMS, strict=True)}
    contact = contact_of_area(250e3, 5.6, 0.05, 400.0)
    deviations = dict.fromkeys(spectra, 0.0) | {SUBSTRATES[0]: 0.1}
    scatter = force_scatter(spectra, contact, [5.6], deviations, tolerance=0.05, confidence=0.9)
    table = pd.read_csv(LIBRARY.parents[1] / "resources/validation/statistics.csv")
    pairs = {"contact_model": ["plastic"], "pair": ["published"], "surface": SUBSTRATES}
    shapes = bounded("lognormal_shape", tuple(pairs), np.full((1, 1, len(SUBSTRATES)), 0.5))
    inference = xr.Dataset(shapes, pairs)
    compared = with_comparison(scatter, inference, published_pull_off(), table)
    named = {"label": ("surface", LABELS), "basis": ("surface", ["substitute"] * len(LABELS))}
    return compared.assign(named).assign_attrs(reference_rho=5.6)
