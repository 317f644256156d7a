"""Formulas of the edges on the designed surfaces of prediction.csv and on two nitrides: edges.csv.

    python tests/benchmarks/validate_edges.py [--table FILE]

No force is computed on a surface: a changed formula is compared with the edges of prediction.csv in
seconds. The columns are described in resources/validation/README.md.
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from validate_prediction import SURFACES, TOLERANCE, WORK, design, spectrum_of

from hardcontact.contact.contact import Contact, contact_of_area
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum, roll_off
from hardcontact.surfaces.substitute_spectra import spectrum_from_description
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.closed_form_errors import spectrum_of_grid
from hardcontact.theory.edge_formulas import formula_edges

RESOURCES = Path(__file__).parents[2] / "resources"
TABLE = RESOURCES / "validation/edges.csv"
#: Published spectra, under the sphere, range and load of the paper.
NITRIDES = ("crn_rougher", "crn_smoother")
PAPER_CONTACT = contact_of_area(radius=250e3, rho=5.6, work=WORK, area=400.0)


def describe_surface(spectrum: Spectrum, contact: Contact) -> dict[str, Any]:
    """Return the coordinates of a surface among the regimes, and its edges by the formulas."""
    form, edges = closed_form(spectrum, contact), formula_edges(spectrum, contact, TOLERANCE)
    return {
        "rms_height_over_range": form.rms_height / contact.range,
        "level": form.apex_height / form.rms_height,
        "contact_over_rolloff": np.sqrt(contact.area) / roll_off(spectrum),
        "short_edge": edges.short,
        "long_edge": edges.long,
    }


def rows(surfaces: int = SURFACES) -> list[dict[str, Any]]:
    """Return the rows of the first surfaces of the design and of the nitrides."""
    designed = []
    for row in design(surfaces):
        waves = spectrum_of_grid(spectrum_of(row), row["size"], row["pixels"])
        contact = contact_of_area(row["radius"], row["rho"], WORK, row["area"])
        designed.append({"surface": str(row["surface"])} | describe_surface(waves, contact))
    for name in NITRIDES:  # No band of theirs is calibrated to the paper's Table 1.
        density, _, _ = spectrum_from_description(
            RESOURCES / f"spectra/{name}.csv", pd.DataFrame(), {}
        )
        designed.append(
            {"surface": name} | describe_surface(Spectrum(WAVEVECTORS, density), PAPER_CONTACT)
        )
    return designed


def main() -> None:
    """Write the table, five digits a number."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--table", type=Path, default=TABLE)
    table = parser.parse_args().table
    pd.DataFrame(rows()).to_csv(table, index=False, float_format="%.5g", lineterminator="\n")


if __name__ == "__main__":
    main()
