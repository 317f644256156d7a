"""Numbers about roughness, of the values of Table 1."""

import numpy as np
from paper_claims import near
from paper_datasets import make_topography
from paper_numbers import SUBSTRATES

from hardcontact.claims.force_quantities import (
    curvature_over_height,
    slope_by_scales,
    slope_over_height,
)


def test_roughness_by_scales():
    topography = make_topography().sel(surface=SUBSTRATES)
    slope = np.array([0.31 / 0.04, 1.17 / 0.39, 0.92 / 0.51, 0.85 / 0.49])
    height = np.array([4.2 / 3.2, 1.0, 97.2 / 97.1, 101.2 / 107.1])
    near(slope_by_scales(topography), slope)
    near(slope_over_height(topography), slope / height)
    curvature = np.array([1.99 / 2e-3, 6.32 / 4.8e-2, 5.91 / 3.9e-2, 5.04 / 2.8e-2])
    near(curvature_over_height(topography), curvature / height)
