"""Descriptions of two chromium nitride coatings, fitted to the published spectra of their profiles.

`python -m hardcontact.study.chromium_nitride TABLE` writes them into resources/spectra/. The table
(CSV: surface, statistic, wavevector_per_nm, c1d_nm3) is digitised from Fig. 9 of Pradhan et al. and
not part of the project; resources/README.md names its source.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from hardcontact.surfaces.local_hurst import LocalHurst, fitted_local_hurst
from hardcontact.surfaces.spectrum import WAVEVECTORS

__all__ = ["EDGES", "STATISTICS", "description", "fitted"]

#: Longest wavelength in nm of each band: where the published spectra bend, the same for all
#: statistics of a coating, chosen by eye.
EDGES = {
    "crn_smoother": (1e6, 3e4, 1e4, 5e3, 2100, 1200, 150, 60, 17, 3.0, 1.5),
    "crn_rougher": (6e4, 2e4, 3400, 1700, 620, 125, 81, 36, 10, 3.7),
}
#: Statistics over the measurements of many laboratories, and what their descriptions' names end in.
STATISTICS = {"median": "", "lower_quartile": "_lower", "upper_quartile": "_upper"}
#: Shortest wavelength published, and the last of the table of a spectrum, in nm.
PUBLISHED_TO, END = 0.24, 0.1
#: Digits of the plateau; the exponents have three decimals.
DIGITS = 4

SOURCE = (
    "A. Pradhan et al., The Surface-Topography Challenge, Tribology Letters 73, 41 (2025), Fig. 9 "
    "(doi 10.1007/s11249-025-02014-y, CC BY 4.0), digitised"
)


def fitted(table: pd.DataFrame, surface: str, statistic: str) -> LocalHurst:
    """Return the fit to one spectrum, at the wavelengths that the study's tables hold.

    Parameters
    ----------
    table : pandas.DataFrame
        The digitised points.
    surface, statistic : str
        Of EDGES and of STATISTICS.

    Returns
    -------
    LocalHurst
        Of `fitted_local_hurst`.
    """
    wavevector, profile = points(table, surface, statistic)
    return fitted_local_hurst(wavevector, profile, np.array(EDGES[surface]))


def points(
    table: pd.DataFrame, surface: str, statistic: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the wavevectors (rad/nm) and C_1D (nm³) of one spectrum, no longer than 1 mm."""
    rows = table[(table.surface == surface) & (table.statistic == statistic)]
    rows = rows[rows.wavevector_per_nm > WAVEVECTORS[0] * (1 - 1e-3)]
    return rows.wavevector_per_nm.to_numpy(float), rows.c1d_nm3.to_numpy(float)


def description(fit: LocalHurst, surface: str, statistic: str) -> pd.DataFrame:
    """Return the description of a coating: a row a band, the last continued beyond the source.

    Parameters
    ----------
    fit : LocalHurst
        Of `fitted`.
    surface, statistic : str
        As there.

    Returns
    -------
    pandas.DataFrame
        With the columns of resources/README.md.
    """
    edges, last = EDGES[surface], len(fit.hurst) - 1
    rms, largest = np.sqrt((fit.misfit**2).mean()), np.abs(fit.misfit).max()
    source = (
        f"local exponents fitted to the {statistic.replace('_', ' ')} of C_1D of {SOURCE}; misfit "
        f"of ln C_1D {rms:.2f} rms and {largest:.2f} at most over {len(fit.misfit)} points"
    )
    rows = []
    for band, hurst in enumerate(fit.hurst):
        rows.append(
            {
                "longest_nm": edges[band] if band else np.inf,
                "shortest_nm": PUBLISHED_TO if band == last else edges[band + 1],
                "model": "power law" if band else "self-affine",
                "plateau_nm4": np.nan if band else float(f"{fit.plateau:.{DIGITS - 1}e}"),
                "rolloff_nm": np.nan if band else edges[0],
                "hurst": round(float(hurst), 3),
                "basis": "measured",
                "source": source,
            }
        )
    beyond = {"longest_nm": PUBLISHED_TO, "shortest_nm": END, "basis": "assumed"}
    rows.append(rows[-1] | beyond | {"source": "continued with the exponent of the band above"})
    columns = [
        "longest_nm", "shortest_nm", "model", "plateau_nm4", "rolloff_nm", "hurst",
        "hurst_change", "table", "basis", "source",
    ]  # fmt: skip
    return pd.DataFrame(rows).reindex(columns=columns)


def main() -> None:
    """Write the descriptions of all coatings and statistics, in the top folder."""
    table = pd.read_csv(sys.argv[1])
    for surface in EDGES:
        for statistic, ending in STATISTICS.items():
            bands = description(fitted(table, surface, statistic), surface, statistic)
            bands.to_csv(
                Path("resources/spectra") / f"{surface}{ending}.csv",
                index=False, lineterminator="\n", float_format="%.10g",
            )  # fmt: skip


if __name__ == "__main__":
    main()
