"""The surfaces and scans that a study is about: its table of surfaces, one row per scan."""

import os
import reprlib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Annotated, Literal

import pandas as pd

from hardcontact.config.key_types import FilePath, Matching, Quantity, or_word
from hardcontact.config.keys import SMOOTH_SPHERE, Keys
from hardcontact.config.user_files import read_rows
from hardcontact.records.origin import file_digest, short_value_digest
from hardcontact.surfaces.substitute_spectra import read_segments

#: Stands for the number of a scan of a smooth sphere; scans are numbered from 1.
NO_SCAN = 0
#: Words in the column `use`: contacts are made on a scan, or it only enters the spectrum.
CONTACT_USE, SPECTRUM_USE = "contact", "spectrum"
#: Ids that surfaces cannot have: they stand for the average over surfaces and for a smooth sphere.
RESERVED_IDS = ("averaged", SMOOTH_SPHERE)
#: The accepted radii (nm) of tips, from a sharp tip to a blunt stylus.
TIP_RADIUS = Quantity("nm", 0.1, 1e5)
LABEL = Matching("[^${}]{1,60}", "a name for figures, up to 60 characters without $, { and }")


class SurfaceRow(Keys):
    """A row of the table of surfaces: one scan."""

    surface: Annotated[
        str,
        Matching(
            f"(?!({'|'.join(RESERVED_IDS)})$)[a-z][a-z0-9_]{{0,39}}",
            "up to 40 lower-case letters, digits and underscores, a letter first, neither "
            f"{' nor '.join(RESERVED_IDS)}",
        ),
    ]
    """Id of the surface."""
    label: Annotated[str, LABEL]
    """Name of the surface in figures, the same in all rows of a surface."""
    scan: Annotated[str, Matching("[1-9][0-9]{0,3}", "the number of the scan, 1 to 9999")]
    """Number of the scan, each once for a surface."""
    source: Literal["measured", "substitute"]
    """Origin of the scans, the same in all rows of a surface."""
    path: FilePath
    """File of a measured scan, or description of a substitute (`resources/README.md`), relative to
    the top folder."""
    dataset: Annotated[str, Matching(".{0,1000}", "a name, or nothing")]
    """Name or data file of a scan in a container (`.zip`), channel of other files, or nothing."""
    use: Literal["", "contact", "spectrum"] = ""
    """Optional. `contact` (or empty): contacts are made on the scan. `spectrum`: the scan only
    enters the spectrum."""
    tip_radius: Annotated[float | str, TIP_RADIUS, or_word("")] = ""
    """Optional. Radius of the tip that measured the scan, in place of what the file states."""


class Selection:
    """The surfaces and scans of a table of surfaces, in its order."""

    def __init__(
        self,
        rows: pd.DataFrame,
        sphere_surface: str,
        digests: Mapping[str, str],
        published_surfaces: Collection[str],
    ) -> None:
        """Take the rows of a study and their `digest_surfaces`; a sphere without rows is smooth."""
        self._rows = rows
        self._contact_rows = rows[rows.use == CONTACT_USE]
        self._cells = rows.set_index(["surface", "scan"])
        self.digests = digests
        self.sphere_surface = sphere_surface
        self.sphere_digest = digests.get(sphere_surface, SMOOTH_SPHERE)
        self.surfaces: list[str] = list(rows.surface.unique())
        self.labels: dict[str, str] = dict(zip(rows.surface, rows.label, strict=True))
        #: ``"measured"`` or ``"substitute"``, by surface.
        self.sources: dict[str, str] = dict(zip(rows.surface, rows.source, strict=True))
        self.measured_surfaces = rows.surface[rows.source == "measured"].unique().tolist()
        self.substitutes = rows.surface[rows.source == "substitute"].unique().tolist()
        #: All surfaces but the sphere's.
        self.substrates = [surface for surface in self.surfaces if surface != sphere_surface]
        self.substitute_substrates = [name for name in self.substrates if name in self.substitutes]
        #: Substitutes for surfaces of the paper, which each set samples.
        self.sampled_substrates = [
            name for name in self.substitute_substrates if name in published_surfaces
        ]

    def contact_scan_numbers(self, surface: str) -> list[int]:
        """Return the numbers of the scans of a surface that contacts are made on."""
        return self._contact_rows.scan[self._contact_rows.surface == surface].tolist()

    @property
    def sphere_scan_numbers(self) -> list[int]:
        """Numbers of the scans of the sphere; NO_SCAN alone for a smooth sphere."""
        return self.contact_scan_numbers(self.sphere_surface) or [NO_SCAN]

    def attributes(self, surface: str) -> dict[str, str]:
        """Return the attributes of a dataset of one surface."""
        return {"surface": surface, "label": self.labels[surface], "source": self.sources[surface]}

    def all_scan_numbers(self, surface: str) -> list[int]:
        """Return the numbers of all scans of a surface, with those of its spectrum alone."""
        return self._rows.scan[self._rows.surface == surface].tolist()

    def tip_radii(self, surface: str) -> list[float | None]:
        """Return the tip radius (nm) of all scans of a surface; None if the table has no radius."""
        texts = self._rows.tip_radius[self._rows.surface == surface]
        return [float(text) if text else None for text in texts]

    def contact_scan_indices(self, surface: str) -> list[int]:
        """Return the indices, from 0, of the scans with contacts among all scans of a surface."""
        uses = self._rows.use[self._rows.surface == surface]
        return [index for index, use in enumerate(uses) if use == CONTACT_USE]

    def path(self, surface: str, scan: int) -> str:
        """Return the file of a measured scan, or the description of a substitute."""
        return str(self._cells.path[surface, scan])

    def dataset(self, surface: str, scan: int) -> str:
        """Return the dataset or channel that the table names for a scan; empty for a substitute."""
        return str(self._cells.dataset[surface, scan]) if surface in self.measured_surfaces else ""

    def description_path(self, surface: str) -> str:
        """Return the file that describes the spectrum of a substitute."""
        return self.path(surface, self.contact_scan_numbers(surface)[0])

    def tables(self, surface: str) -> list[str]:
        """Return the paths of the tables of points that the description of a substitute names."""
        description = self.description_path(surface)
        names = read_segments(description).table.dropna().unique()
        return [(Path(description).parent / name).as_posix() for name in names]


def surface_table(path: str | Path) -> pd.DataFrame:
    """Return the rows of the table of surfaces with the columns of `SurfaceRow`, by line.

    `scan` is an int, `tip_radius` a number in nm as text or empty.
    """
    if not os.path.isfile(path):
        raise ValueError(f"config key surfaces: expected a table of surfaces, found no file {path}")
    content = "a table of surfaces, the columns {}, separated by tabs, and a row per scan"
    rows = read_rows(path, SurfaceRow, content, form="a table of surfaces", separator="\t")
    cells = {line: row.model_dump() for line, row in rows.items()}
    table = pd.DataFrame.from_dict(cells, orient="index", dtype=str)
    table["scan"] = table["scan"].astype(int)
    table["use"] = table["use"].replace("", CONTACT_USE)
    _refuse_repeated(path, table, ["surface", "scan"])
    _refuse_repeated(path, table[table.source == "measured"], ["path", "dataset"])
    _refuse_disagreement(path, table)
    for line, file in table.path.items():
        if not os.path.isfile(file):
            raise ValueError(f"{path}: line {line}: expected the file {file}, found no such file")
    return table


def digest_surfaces(rows: pd.DataFrame) -> dict[str, str]:
    """Return a digest of the rows and files of each surface, for the paths of intermediates."""
    cells = rows.assign(path=rows.path.map(file_digest)).drop(columns="label").astype(str)
    surfaces = cells.groupby("surface")
    return {str(name): short_value_digest(surface.to_dict("records")) for name, surface in surfaces}


def selected_scans(table: pd.DataFrame, scans: Literal["all"] | list[int]) -> pd.DataFrame:
    """Return the rows that a study uses, by the key `scans`."""
    if scans == "all":
        return table
    existing = sorted({int(scan) for scan in table.scan})
    if unknown := sorted({*scans} - {*existing}):
        raise ValueError(
            f"config key scans: expected numbers of scans in the table {reprlib.repr(existing)}, "
            f"found {reprlib.repr(unknown)}"
        )
    return table[table.scan.isin(scans)]


def _refuse_repeated(path: str | Path, table: pd.DataFrame, columns: list[str]) -> None:
    """Refuse a row that repeats the values of an earlier row in all of these columns."""
    repeated = table[table.duplicated(columns)]
    if len(repeated):
        values = " ".join(str(repeated.iloc[0][column]) for column in columns)
        raise ValueError(
            f"{path}: line {repeated.index[0]}: expected each "
            f"{' and '.join(columns)} once, found again {values}"
        )


def _refuse_disagreement(path: str | Path, table: pd.DataFrame) -> None:
    """Refuse a surface whose rows disagree, or whose column `use` does not fit."""
    for surface, rows in table.groupby("surface"):
        location = f"{path}: surface {surface}"
        uses = rows.use.unique()
        shared_columns = ["label", "source"]
        if rows.source.iloc[0] == "substitute":
            shared_columns.append("path")
            if list(uses) != [CONTACT_USE]:
                raise ValueError(
                    f"{location}: expected the use {CONTACT_USE} of substitutes, found "
                    f"{', '.join(uses)}"
                )
        if CONTACT_USE not in uses:
            raise ValueError(f"{location}: expected a scan with the use {CONTACT_USE}, found none")
        for column in shared_columns:
            values = rows[column].unique()
            if len(values) > 1:
                raise ValueError(
                    f"{location}: expected one {column}, found {', '.join(values[:5])}"
                )
