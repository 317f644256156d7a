"""The plan of a study: on which scans, bodies and positions it computes contacts."""

import math
from collections import defaultdict
from collections.abc import Mapping
from typing import Any, NamedTuple

from hardcontact.config.configuration import is_paper_study, study_contact
from hardcontact.config.selected_surfaces import Selection
from hardcontact.surfaces.synthesis import master_scan_index

#: Minimum number of positions on a rough sphere that touch each surface of the user. With 16 an
#: interval is 1.1 times as wide as with many positions; each position costs computing time.
SPHERE_POSITIONS = 16
#: Contacts per row at each of several positions: 16 times 36 contacts in place of 400.
POSITION_CONTACTS_PER_ROW = 6


class ScanId(NamedTuple):
    """The surface and the number of a scan; both are wildcards of paths."""

    surface: str
    scan: int


class StudyPlan:
    """Settings of a study that follow from its keys and from its selected surfaces together."""

    def __init__(self, study: Mapping[str, Any], selection: Selection) -> None:
        self.study = study
        self.selection = selection
        self.contact = study_contact(study)

    @property
    def scan_ids(self) -> list[ScanId]:
        """The scans with contacts of all surfaces."""
        return [
            ScanId(surface, scan)
            for surface in self.selection.surfaces
            for scan in self.selection.contact_scan_numbers(surface)
        ]

    @property
    def substrate_scan_ids(self) -> list[ScanId]:
        """The scans with contacts of all substrates."""
        sphere = self.selection.sphere_surface
        return [scan_id for scan_id in self.scan_ids if scan_id.surface != sphere]

    @property
    def measured_scan_ids(self) -> list[ScanId]:
        """The scans with contacts of measured substrates."""
        measured = self.selection.measured_surfaces
        return [scan_id for scan_id in self.substrate_scan_ids if scan_id.surface in measured]

    @property
    def scan_batches(self) -> dict[tuple[int, ...], list[str]]:
        """The substitutes that have each batch: the numbers of scans that one job makes.

        The first batch of a surface has its scans of the study. In the paper's study each master
        needs its own scan, so more batches, each as large as the first, have scans for masters.
        With 5 scans and 20 masters of sets the batches are 1 to 5, 6 to 10, 11 to 15 and 16 to 20.
        """
        master_count = max(self.study[name]["masters"] for name in ("band", "sets", "exponents"))
        surfaces_by_batch = defaultdict[tuple[int, ...], list[str]](list)
        for surface in self.selection.substitutes:
            numbers = self.selection.contact_scan_numbers(surface)
            last_number = self.master_scan_number(surface, master_count)
            surfaces_by_batch[tuple(numbers)].append(surface)
            for start in range(max(numbers) + 1, last_number + 1, len(numbers)):
                surfaces_by_batch[tuple(range(start, start + len(numbers)))].append(surface)
        return surfaces_by_batch

    def master_scan_number(self, surface: str, realization: int) -> int:
        """Return the number of the scan from which a master is made.

        In the paper's study each master of a substitute has its own scan. Other masters take scans
        in turn, and their intervals take this into account.
        """
        numbers = self.selection.contact_scan_numbers(surface)
        is_measured = surface in self.selection.measured_surfaces
        if realization > len(numbers) and is_paper_study(self.study) and not is_measured:
            return max(numbers) + realization - len(numbers)
        return numbers[master_scan_index(realization, len(numbers))]

    def sphere_radius(self, surface: str) -> float | None:
        """Return the radius (nm) to subtract from scans of the sphere, None for other surfaces."""
        return self.contact.radius if surface == self.selection.sphere_surface else None

    @property
    def featured_surface(self) -> str | None:
        """The substitute of the paper whose scans have features, None in a study without it."""
        surface = self.study["substitutes"]["featured_surface"]
        return surface if surface in self.selection.sampled_substrates else None

    @property
    def combined_surfaces(self) -> list[str]:
        """The measured substrates to which the roughness of a measured sphere is added."""
        measured = self.selection.measured_surfaces
        if is_paper_study(self.study) or self.selection.sphere_surface not in measured:
            return []
        return [name for name in self.selection.substrates if name in measured]

    def body_scan_ids(self, surface: str, scan: int) -> list[ScanId]:
        """Return a substrate's scan, and the sphere's scan if its roughness is added."""
        scan_ids = [ScanId(surface, scan)]
        if surface in self.combined_surfaces:
            sphere_scan = self.sphere_scan_number(surface, scan)
            scan_ids.append(ScanId(self.selection.sphere_surface, sphere_scan))
        return scan_ids

    def sphere_scan_number(self, surface: str, scan: int) -> int:
        """Return the number of the sphere's scan that meets a scan of a substrate, in turn."""
        sphere_numbers = self.selection.sphere_scan_numbers
        index = self.selection.contact_scan_numbers(surface).index(scan)
        return sphere_numbers[index % len(sphere_numbers)]

    def measurement_indices(self, surface: str, scan: int) -> list[int]:
        """Return which of all scans of both bodies a contact map consists of, as indices from 0."""
        body_scan_ids = self.body_scan_ids(surface, scan)
        all_scan_ids = [
            ScanId(body.surface, number)
            for body in body_scan_ids
            for number in self.selection.all_scan_numbers(body.surface)
        ]
        return [all_scan_ids.index(scan_id) for scan_id in body_scan_ids]

    @property
    def positions_per_row(self) -> int:
        """Positions per row of the square array of positions on each scan of the sphere."""
        # A smooth sphere has no row.
        is_rough = self.selection.sphere_surface in self.selection.surfaces
        minimum = SPHERE_POSITIONS if is_rough and not is_paper_study(self.study) else 1
        return math.ceil(math.sqrt(minimum / len(self.selection.sphere_scan_numbers)))

    @property
    def sphere_positions(self) -> list[int]:
        """Numbers of the positions on the sphere: those of its scans if each has one position."""
        scan_numbers = self.selection.sphere_scan_numbers
        if self.positions_per_row == 1:
            return scan_numbers
        return list(range(1, len(scan_numbers) * self.positions_per_row**2 + 1))

    @property
    def contacts_per_row_at_position(self) -> int:
        """Contacts per row of the array at each position: fewer if there are several."""
        if self.positions_per_row == 1:
            return self.contact.contacts_per_row
        return min(self.contact.contacts_per_row, POSITION_CONTACTS_PER_ROW)
