"""The roughness of polished UNCD in Table 1."""

import numpy as np

from hardcontact.surfaces.features import ScanStatistics

POLISHED = ScanStatistics(
    np.array([3.2, 0.04, 2e-3]), np.array([1.6, 0.01, 1.3e-3]), scans=5, all_rms_height=4.2
)
