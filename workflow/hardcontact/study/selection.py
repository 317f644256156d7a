"""The surfaces and scans that a study is about: the selected rows of its table of surfaces."""

from pathlib import Path

import pandas as pd

__all__ = ["Selection"]

HEIGHT_DISTRIBUTION = "resources/spectra/height_distribution.csv"


class Selection:
    """What the rows of a table of surfaces say, asked for by surface.

    Parameters
    ----------
    rows : DataFrame
        One row a scan, as `surface_table.selected_scans` returns them.
    sphere : str
        Name of the surface that is the sphere's.

    Attributes
    ----------
    surfaces, substrates : list of str
        In the order of the table; substrates are all but the sphere's.
    labels, basis : dict
        By surface, the name to print and ``"measured"`` or ``"substitute"``.
    """

    def __init__(self, rows: pd.DataFrame, sphere: str) -> None:
        self._rows = rows
        self.sphere = sphere
        self.surfaces: list[str] = list(rows.surface.unique())
        self.substrates = [surface for surface in self.surfaces if surface != sphere]
        self.labels: dict[str, str] = dict(zip(rows.surface, rows.label, strict=True))
        self.basis: dict[str, str] = dict(zip(rows.surface, rows.source, strict=True))
        table = pd.read_csv(HEIGHT_DISTRIBUTION)
        self._skewness = dict(zip(table.description, table.skewness, strict=True))

    def scans(self, surface: str) -> list[int]:
        """Return the numbers of the scans of a surface."""
        return [int(scan) for scan in self._rows.scan[self._rows.surface == surface]]

    def path(self, surface: str, scan: int) -> str:
        """Return the file of a measured scan, or the description of a substitute."""
        return self._cell(surface, scan, "path")

    def dataset(self, surface: str, scan: int) -> str:
        """Return which dataset of its container a scan is; empty of a plain file."""
        return self._cell(surface, scan, "dataset")

    def undefined_pixels(self, surface: str, choice: str) -> str:
        """Return what is done with undefined pixels of a surface: substitutes have none."""
        return choice if self.basis[surface] == "measured" else "refuse"

    def description(self, surface: str) -> str:
        """Return the file that describes the spectrum of a substitute."""
        return self.path(surface, self.scans(surface)[0])

    def tables(self, surface: str) -> list[str]:
        """Return the tables of measured points that the description of a substitute names."""
        description = self.description(surface)
        names = pd.read_csv(description).table.dropna().unique()
        return [(Path(description).parent / name).as_posix() for name in names]

    def skewness(self, surface: str) -> float:
        """Return the skewness of the heights of a substitute, zero where none is known."""
        return float(self._skewness.get(Path(self.description(surface)).stem, 0.0))

    def reads_curvature(self, surface: str) -> bool:
        """Return whether a substitute depends on what the curvature of Table 1 is read as."""
        bands = pd.read_csv(self.description(surface))
        return bool((bands.hurst.isna() & bands.model.isin(["self-affine", "power law"])).any())

    def _cell(self, surface: str, scan: int, column: str) -> str:
        rows = self._rows
        return str(rows[(rows.surface == surface) & (rows.scan == scan)].iloc[0][column])
