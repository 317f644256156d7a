"""Every list of files of the chapter on what decides the critical band."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from hardcontact.config.files import Files
from hardcontact.config.patterns import STUDY_VARIANT, Patterns
from hardcontact.config.selection import Selection
from hardcontact.config.variants import named_load
from hardcontact.contact.bearing_area import NamedLoad
from hardcontact.numbers.units import magnitude
from hardcontact.surfaces.synthesis import SIDES


class Repeated(NamedTuple):
    """What a file of repeated contact is of: substrate, preload in N, scan."""

    surface: str
    preload: float
    scan: int


class InsightFiles(Files):
    """The files of the chapter in lists; parameters as those of `Files`."""

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        super().__init__(configuration, selection, patterns)
        self._realizations = configuration["insight"]["realizations"]
        self._scaled = configuration["insight"]["scaling"]["realizations"]
        contact, indent = configuration["contact"], configuration["indent"]
        hardest = max(indent["preloads"], key=lambda preload: magnitude(preload, "N"))
        self._indented = indent["surface"]
        self._loads = [
            named_load(preload, contact["hardness"]) for preload in (contact["preload"], hardest)
        ]

    @property
    def realized_scans(self) -> list[tuple[str, int]]:
        """Surface and number of the first scans of every substrate, one a realization."""
        return self._first_scans(self._realizations)

    def of_scans(self, pattern: str) -> list[str]:
        """Return the files of a pattern, one a scan."""
        return [
            self._of_surface(pattern, surface, STUDY_VARIANT, scan=scan)
            for surface, scan in self.realized_scans
        ]

    @property
    def scaled(self) -> dict[str, tuple[str, int, str]]:
        """Each file of masters at several spheres, ranges and areas: surface, scan, side."""
        masters = [
            (surface, scan, side)
            for surface, scan in self._first_scans(self._scaled)
            for side in SIDES
        ]
        paths = [
            self._of_surface(self._patterns.scaled, surface, STUDY_VARIANT, scan=scan, side=side)
            for surface, scan, side in masters
        ]
        return dict(zip(paths, masters, strict=True))

    @property
    def filtered_windows(self) -> dict[str, str]:
        """Each file of forces on filtered windows, and its surface."""
        pattern = self._patterns.filtered_windows
        return {
            self._of_surface(pattern, surface, STUDY_VARIANT): surface
            for surface in self._selection.substrates
        }

    def _first_scans(self, count: int) -> list[tuple[str, int]]:
        """Return surface and number of the first so many scans of every substrate."""
        return [
            (surface, scan)
            for surface in self._selection.substrates
            for scan in self._selection.scans(surface)[:count]
        ]

    @property
    def repeated_loads(self) -> dict[str, NamedLoad]:
        """The load of the study and that of the published image of indents, by their names."""
        return {load["name"]: load for load in self._loads}

    @property
    def repeated(self) -> dict[str, Repeated]:
        """Each file of repeated contact and what it is of: all surfaces, the imaged one twice."""
        of_study, of_image = self._loads
        return {
            self._patterns.repeated_contact.format(
                **pair._asdict(), **self._swept | {"load": load["name"]}
            ): Repeated(pair.surface, load["preload"], pair.scan)
            for load in (of_study, of_image)
            for pair in self.pairs_in_turn
            if (pair.surface, pair.scan) in self.realized_scans
            and (load is of_study or pair.surface == self._indented)
        }
