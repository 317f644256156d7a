"""Chunks: what one job computes together. The fields of a chunk are the wildcards of its path."""

from dataclasses import replace
from math import ceil
from typing import NamedTuple

from hardcontact.base.units import path_token
from hardcontact.config.keys import SMOOTH_SPHERE
from hardcontact.files.paths import SurfaceFiles
from hardcontact.files.purposes import MASTERS_PER_JOB, Purpose
from hardcontact.surfaces.features import FEATURE_SIGNS, GAUSSIAN
from hardcontact.surfaces.synthesis import SIDES

#: Scans of a pool in one job: like MASTERS_PER_JOB, a trade-off of busy cores against starts.
POOL_SCANS_PER_JOB = 15
#: Candidates with features in one job; one candidate takes longer than one scan of a pool.
CANDIDATES_PER_JOB = 10


class Chunk(NamedTuple):
    """A surface, and the numbers of the first and the last scan or whole surface of a chunk."""

    surface: str
    first: int
    last: int


class CandidateChunk(NamedTuple):
    """A surface, and the numbers of the first and the last candidate with one kind of features."""

    surface: str
    features: str
    first: int
    last: int


class MasterForcesChunk(NamedTuple):
    """The first and the last master of a chunk, and what else the path of their forces names.

    The digest of settings keeps forces with other radii, loadings or ranges apart. These have
    fields, too, so that people find a file.
    """

    purpose: str
    settings_digest: str
    surface: str
    sphere_digest: str
    first: int
    last: int
    radii: str
    loadings: str
    ranges: str


def _spans(count: int, step: int) -> list[tuple[int, int]]:
    """Return the first and the last number of each span of `step` numbers, from 1 to `count`."""
    return [(start, min(start + step - 1, count)) for start in range(1, count + 1, step)]


class Chunks:
    """The chunks of one study, by what is computed in them."""

    def __init__(self, files: SurfaceFiles) -> None:
        self._files = files
        self._purposes = files.patterns.purposes
        self._plan = files.plan
        self._study = files.plan.study
        self._selection = files.selection

    @property
    def pools(self) -> list[Chunk]:
        """The scans of all pools, for the sets: outputs of rule compute_pool."""
        spans = _spans(self._study["sets"]["pool_size"], POOL_SCANS_PER_JOB)
        return [
            Chunk(surface, *span)
            for surface in self._selection.sampled_substrates
            if surface != self._plan.featured_surface
            for span in spans
        ]

    @property
    def featured_candidates(self) -> list[CandidateChunk]:
        """The candidates with features, for the sets: outputs of compute_featured_candidates."""
        surface = self._plan.featured_surface
        if surface is None:
            return []
        # Each set takes one candidate, bumps and pits in turn.
        candidates_per_kind = ceil(self._study["sets"]["count"] / len(FEATURE_SIGNS))
        counts = {feature_kind: candidates_per_kind for feature_kind in FEATURE_SIGNS}
        # Gaussian surfaces only serve for comparison.
        counts[GAUSSIAN] = min(candidates_per_kind, CANDIDATES_PER_JOB)
        return [
            CandidateChunk(surface, feature_kind, *span)
            for feature_kind, count in counts.items()
            for span in _spans(count, CANDIDATES_PER_JOB)
        ]

    @property
    def whole_surfaces(self) -> list[Chunk]:
        """The whole surfaces of all substitutes: outputs of rule compute_whole_surface_forces."""
        spans = _spans(self._study["band"]["whole_surfaces"], MASTERS_PER_JOB)
        substitutes = self._selection.substitute_substrates
        return [Chunk(surface, *span) for surface in substitutes for span in spans]

    def master_forces(self, purpose_name: str) -> list[MasterForcesChunk]:
        """Return the chunks of masters of a purpose: outputs of rule compute_filtered_forces."""
        purpose = self._purposes[purpose_name]
        spans = _spans(purpose.master_count, purpose.masters_per_job)
        contacts = [replace(self._plan.contact, **loading) for loading in purpose.loadings]
        substrates = self._selection.substrates
        if purpose.samples_spectra:  # only spectra of measured surfaces are sampled
            substrates = [name for name in substrates if name in self._selection.measured_surfaces]
        return [
            MasterForcesChunk(
                purpose=purpose_name,
                settings_digest=self._files.patterns.digests[purpose_name],
                surface=surface,
                sphere_digest=self._sphere_digest(purpose, surface),
                first=first,
                last=last,
                radii="+".join(f"R{path_token(radius, 'um')}" for radius in purpose.radii),
                loadings="+".join(contact.loading_name for contact in contacts),
                ranges="+".join(f"rho{path_token(rho, 'nm')}" for rho in purpose.ranges),
            )
            for surface in substrates
            for first, last in spans
        ]

    def _sphere_digest(self, purpose: Purpose, surface: str) -> str:
        """Return the sphere's digest, SMOOTH_SPHERE if the masters touch a smooth sphere."""
        if purpose.has_rough_sphere and surface not in self._plan.combined_surfaces:
            return self._selection.sphere_digest
        return SMOOTH_SPHERE

    def master_inputs(
        self, purpose_name: str, surface: str, first: int, last: int
    ) -> dict[str, list[str]]:
        """Return the inputs of rule compute_filtered_forces: by name, a file for each master."""
        purpose, files = self._purposes[purpose_name], self._files
        realizations = range(first, last + 1)
        if purpose.masters_are_files:
            return {
                f"{side}_masters": [
                    files.path(files.patterns.masters, surface, realization=realization, side=side)
                    for realization in realizations
                ]
                for side in SIDES
            }
        # Masters that are no files: the job makes them from scans and spectra.
        if purpose.samples_spectra:
            spectra = [
                files.sampled_spectrum_path(surface, realization) for realization in realizations
            ]
        else:
            spectra = [files.spectrum_path(surface)] * len(realizations)
        scan_numbers = [
            self._plan.master_scan_number(surface, realization) for realization in realizations
        ]
        scans = [files.contact_map_path(surface, scan) for scan in scan_numbers]
        return {"scans": scans, "spectra": spectra}
