"""Claims and numbers of the paper, numbers of surfaces in the order of SUBSTRATES."""

from functools import cache

import numpy as np
from repository import ROOT

from hardcontact.base import published
from hardcontact.contact.hertz_jkr_dmt import RUBY_ON_DIAMOND_MODULUS
from hardcontact.paper.claims.statements import read_claims
from hardcontact.paper.classical_models import ElasticSphere, Roughness
from hardcontact.surfaces.features import ScanStatistics
from hardcontact.surfaces.substitute_spectra import substitute_spectrum

SUBSTRATES = ["polished_uncd", "uncd", "ncd", "mcd"]
LABELS = ["polished UNCD", "UNCD", "NCD", "MCD"]
SURFACES = [*SUBSTRATES, "ruby"]
#: Mean pull-off forces on SUBSTRATES in N.
MEAN_FORCE = np.array([8.8e-6, 0.4e-6, 0.16e-6, 0.11e-6])
#: Values and uncertainties of SUBSTRATES in Table 1: heights in nm, curvatures in 1/nm.
TABLE1 = {
    "afm_rms_height": ([3.2, 17.4, 97.1, 107.1], [1.6, 2.1, 11.2, 12.0]),
    "afm_rms_slope": ([0.04, 0.39, 0.51, 0.49], [0.01, 0.05, 0.07, 0.07]),
    "afm_rms_curvature": ([2.0e-3, 4.8e-2, 3.9e-2, 2.8e-2], [1.3e-3, 3.8e-3, 1.1e-2, 6.6e-3]),
    "all_rms_height": ([4.2, 17.4, 97.2, 101.2], [0.8, 1.3, 11.7, 8.0]),
    "all_rms_slope": ([0.31, 1.17, 0.92, 0.85], [0.08, 0.28, 0.10, 0.10]),
    "all_rms_curvature": ([1.99, 6.32, 5.91, 5.04], [0.35, 1.20, 1.83, 1.45]),
}
#: Radius of the sphere in nm.
RADIUS = 250e3
#: Equilibrium spacing in nm.
SPACING = 0.3
#: Work of adhesion in J/m².
WORK = 0.0463
MODULUS = RUBY_ON_DIAMOND_MODULUS
SPHERE = ElasticSphere(RADIUS, MODULUS, SPACING)
AFM = Roughness(*(np.array(TABLE1[f"afm_rms_{name}"][0]) for name in Roughness._fields))
#: Polished UNCD in Table 1.
POLISHED = ScanStatistics(
    np.array([3.2, 0.04, 2e-3]), np.array([1.6, 0.01, 1.3e-3]), scan_count=5, all_rms_height=4.2
)
TABLES = ROOT / "resources/paper"
CLAIMS = read_claims(TABLES / "claims.csv")
CONSTANTS = published.read_constants(TABLES / "constants.csv")
PARAMETERS = CONSTANTS["value"]


def table1_rows(surface):
    """Return the rows of Table 1 of a surface."""
    return published.rows_of_surface(published.read_table1(TABLES / "table1.csv"), surface)


@cache
def default_spectrum(surface):
    """Return the stored spectrum of a default substitute."""
    path = ROOT / f"resources/spectra/{surface}.csv"
    return substitute_spectrum(path, table1_rows(surface), CONSTANTS)
