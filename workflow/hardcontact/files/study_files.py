"""The lists of files that rules ask for: pools, draws, whole surfaces, and filtered masters.

Each entry of a list is a row, whose fields are the wildcards of a pattern.
"""

from collections import namedtuple
from collections.abc import Iterable
from dataclasses import replace
from math import ceil
from typing import Any

from hardcontact.base.origin import short_digest
from hardcontact.base.units import path_token
from hardcontact.config.configuration import combines_bodies, get_key
from hardcontact.files.master_purposes import (
    MASTERS_CHUNK,
    PURPOSES,
    contact_grid,
    filter_settings,
)
from hardcontact.files.patterns import SCAN_KEYS, values_of_keys
from hardcontact.files.surface_files import SurfaceFiles
from hardcontact.surfaces.features import GAUSSIAN, SIGNS
from hardcontact.surfaces.synthesis import SIDES

#: Scans of a pool, and draws of surfaces with features, in one job: a trade, as MASTERS_CHUNK is.
#: Jobs stay as they are if a study has more of them.
CHUNK = 15
DRAWS_CHUNK = 10
#: The shortest range of adhesion (nm) on whole surfaces. They may rise several hundred shorter
#: ranges above a contact, more than the exponential of a floating-point number holds.
SHORTEST_WHOLE_RANGE = 0.7

# Rows of lists
Chunk = namedtuple("Chunk", "surface first last")
DrawChunk = namedtuple("DrawChunk", "surface features first last")
FilteredMasters = namedtuple(
    "FilteredMasters", "purpose settings surface probe first last radii loads ranges"
)


def _chunks(count: int, step: int) -> list[tuple[int, int]]:
    """Return the first and the last of each chunk of the numbers from 1 to a count."""
    return [(start, min(start + step - 1, count)) for start in range(1, count + 1, step)]


class Files(SurfaceFiles):
    """The files of one study.

    Rules ask it for lists of rows, which `paths` turns into paths of files:

    - `chunks` and `draw_chunks`: what compute_pool and compute_draws make for the sets
    - `whole_chunks`: what compute_whole makes
    - `filtered_masters`: what filter_masters makes of the `master_sources` of each row

    `SurfaceFiles` has the files of the surfaces themselves.
    """

    # Pools, draws and whole surfaces

    @property
    def chunks(self) -> list[Chunk]:
        """The scans of all pools, in chunks that are computed together."""
        chunks = _chunks(self._configuration["sets"]["pool"], CHUNK)
        pooled = [name for name in self._selection.pooled if name not in self.featured]
        return [Chunk(surface, *chunk) for surface in pooled for chunk in chunks]

    @property
    def featured(self) -> list[str]:
        """The substrate whose scans have features, if it is a substitute of a published surface."""
        surface = self._configuration["scan"]["featured_surface"]
        return [name for name in self._selection.pooled if name == surface]

    @property
    def draw_chunks(self) -> list[DrawChunk]:
        """The draws of surfaces with features, in chunks that are computed together.

        Each set takes one draw, of bumps and pits in turn. Gaussian surfaces make one chunk.
        """
        draws = ceil(self._configuration["sets"]["replicates"] / len(SIGNS))
        counts = dict.fromkeys(SIGNS, draws) | {GAUSSIAN: min(draws, DRAWS_CHUNK)}
        return [
            DrawChunk(surface, kind, *chunk)
            for surface in self.featured
            for kind, count in counts.items()
            for chunk in _chunks(count, DRAWS_CHUNK)
        ]

    @property
    def whole_chunks(self) -> list[Chunk]:
        """The whole surfaces of all substitute substrates, in chunks that are computed together."""
        chunks = _chunks(self._configuration["scales"]["whole_surfaces"], MASTERS_CHUNK)
        return [Chunk(surface, *chunk) for surface in self.substitutes for chunk in chunks]

    @property
    def whole_grid(self) -> dict[str, Any]:
        """Pixels along a side of a whole surface, and their size (nm), as of large masters."""
        scan = self._configuration["scan"]
        tiles = self._configuration["scales"]["long"]["tiles"]
        return {"pixels": 2 * tiles * scan["pixels"], "pixel_size": scan["size"] / scan["pixels"]}

    # Masters

    def filtered_masters(self, purpose: str = "scales") -> list[FilteredMasters]:
        """Return the masters of a purpose, in rows of realizations that are computed together."""
        count = get_key(self._configuration, PURPOSES[purpose].realizations)
        chunks = _chunks(count, PURPOSES[purpose].realizations_in_job)
        same_fields = {
            "purpose": purpose,
            "settings": self._settings_digest(purpose),
            **self._grid_names(purpose),
        }
        return [
            FilteredMasters(
                surface=surface,
                probe=self._probe(purpose, surface),
                first=first,
                last=last,
                **same_fields,
            )
            for surface in self._master_surfaces(purpose)
            for first, last in chunks
        ]

    def _master_surfaces(self, purpose: str) -> list[str]:
        """Return the substrates with masters; only spectra of measured surfaces are sampled."""
        substrates = self._selection.substrates
        if purpose == "sampled":
            return [name for name in substrates if self._selection.basis[name] == "measured"]
        return substrates

    def _probe(self, purpose: str, surface: str) -> str:
        """Return which sphere touches the masters; combined if they have its roughness, too."""
        if surface in self.combined_surfaces:
            return "combined"
        is_rough = self._configuration["scales"]["sphere_roughness"] and purpose != "scaling"
        return "rough" if is_rough else "smooth"

    def _grid_names(self, purpose: str) -> dict[str, str]:
        """Return radii, loads and ranges of a purpose as parts of paths."""
        grid = contact_grid(self._configuration, purpose)
        return {
            "radii": "+".join(f"R{path_token(radius, 'um')}" for radius in grid["radii"]),
            "loads": "+".join(replace(self.contact, **load).load for load in grid["loads"]),
            "ranges": "+".join(f"rho{path_token(rho, 'nm')}" for rho in grid["ranges"]),
        }

    def _settings_digest(self, purpose: str) -> str:
        """Return a digest of all that the forces of a purpose depend on, but for the path."""
        configuration = self._configuration
        values = values_of_keys(configuration, (*SCAN_KEYS, "contact.window", "sphere.surface"))
        if configuration["scales"]["sphere_roughness"] or combines_bodies(configuration):
            values["sphere"] = self._defaults["sphere_sources"]
        return short_digest([filter_settings(configuration, purpose), values])

    def master_sources(self, row: Any) -> dict[str, list[str]]:
        """Return what rule filter_masters reads for a row, one file a realization.

        Masters of the study are files; others are made from scans and spectra.
        """
        realizations = range(int(row.first), int(row.last) + 1)
        if PURPOSES[row.purpose].generator_name is None:
            return self._master_files(row.surface, realizations)
        is_sampled = row.purpose == "sampled"
        scans = [
            self.stitched_of_realization(row.surface, realization, separate_scans=not is_sampled)
            for realization in realizations
        ]
        if is_sampled:
            spectra = self._sampled_spectra(row.surface, realizations)
        else:
            spectra = [self.spectrum(row.surface)] * len(scans)
        return {"scans": scans, "spectra": spectra}

    def _master_files(self, surface: str, realizations: Iterable[int]) -> dict[str, list[str]]:
        """Return the masters of a surface, by side."""
        pattern = self._patterns.master
        return {
            f"{side}_masters": [
                self.path(pattern, surface, realization=realization, side=side)
                for realization in realizations
            ]
            for side in SIDES
        }

    def _sampled_spectra(self, surface: str, realizations: Iterable[int]) -> list[str]:
        """Return the sampled spectra of a surface, with the sphere's if its roughness is added."""
        is_combined = surface in self.combined_surfaces
        patterns = self._patterns
        pattern = patterns.both_sampled_spectrum if is_combined else patterns.sampled_spectrum
        return [self.path(pattern, surface, realization=number) for number in realizations]
