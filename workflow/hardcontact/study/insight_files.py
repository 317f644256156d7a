"""Every list of files of the chapter on what decides the critical band."""

from collections.abc import Mapping
from typing import Any

from hardcontact.study.patterns import STUDY_VARIANT, Patterns
from hardcontact.study.selection import Selection
from hardcontact.study.single_files import SingleFiles

__all__ = ["InsightFiles"]


class InsightFiles(SingleFiles):
    """The files of the chapter in lists; parameters as those of `SingleFiles`."""

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        super().__init__(configuration, selection, patterns)
        self._realizations = configuration["insight"]["realizations"]

    @property
    def scans(self) -> list[tuple[str, int]]:
        """Surface and number of the first scans of every substrate, one a realization."""
        return [
            (surface, scan)
            for surface in self._selection.substrates
            for scan in self._selection.scans(surface)[: self._realizations]
        ]

    def of_scans(self, pattern: str) -> list[str]:
        """Return the files of a pattern, one a scan."""
        return [
            self._of_surface(pattern, surface, STUDY_VARIANT, scan=scan)
            for surface, scan in self.scans
        ]
