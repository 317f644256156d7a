"""Every file of one study: those of surfaces, of further scans, and of masters."""

from collections import namedtuple
from dataclasses import replace
from math import ceil
from typing import Any

from hardcontact.base.units import path_token
from hardcontact.config.configuration import get_key, master_keys
from hardcontact.config.patterns import short_digest
from hardcontact.config.surface_files import SurfaceFiles
from hardcontact.surfaces.features import GAUSSIAN, SIGNS
from hardcontact.surfaces.synthesis import SIDES

#: Scans of a pool, realizations of masters (not those of the scales), and draws of surfaces with
#: features in one job. A trade: long beside the half second in which a job starts, and enough
#: jobs to share out among cores. Jobs stay as they are if a study has more of them.
CHUNK = 15
MASTERS_CHUNK = 5
DRAWS_CHUNK = 10
#: A range of adhesion (nm) that is much shorter than the published range.
SHORT_RANGE = 1.0
#: The shortest range of adhesion (nm) on whole surfaces. They may rise several hundred shorter
#: ranges above a contact, more than the exponential of a floating-point number holds.
SHORTEST_WHOLE_RANGE = 0.7
#: Loads of the scaling relative to the preload. An eighth makes the side of the contact 2.8 times
#: shorter and leaves some 30 pixels; larger loads move short edges beyond the cutoffs of the sets.
PRELOAD_SHARES = (1 / 8, 1)

# Rows of lists: their fields are wildcards of patterns.
Chunk = namedtuple("Chunk", "surface first last")
DrawChunk = namedtuple("DrawChunk", "surface features first last")
FilteredMasters = namedtuple(
    "FilteredMasters", "purpose settings surface probe first last radii loads ranges"
)


def _chunks(count: int, step: int) -> list[tuple[int, int]]:
    """Return the first and the last of each chunk of the numbers from 1 to a count."""
    return [(start, min(start + step - 1, count)) for start in range(1, count + 1, step)]


class Files(SurfaceFiles):
    """The files of one study, with its load.

    Lists are of rows whose fields are wildcards of patterns: `paths` gives the files.
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
        """Pixels along a side of a whole surface, and their size (nm): those of a large master."""
        scan = self._configuration["scan"]
        tiles = self._configuration["scales"]["large"]["tiles"]
        return {"pixels": 2 * tiles * scan["pixels"], "pixel_size": scan["size"] / scan["pixels"]}

    # Masters

    def contact_grid(self, purpose: str) -> dict[str, list[Any]]:
        """Return radii (nm), loads (N, Pa) and ranges (nm) that masters are filtered at."""
        contact = self.contact
        contacts, radii, ranges = [contact], [contact.radius], [contact.rho]
        if purpose == "scaling":
            preloads = [share * contact.preload for share in PRELOAD_SHARES]
            contacts = [replace(contact, preload=preload) for preload in preloads]
            radii = self._configuration["scaling"]["radii"]
        elif purpose == "enhancement":
            contacts = [contact, replace(contact, plastic=False)]
            ranges = [SHORT_RANGE, contact.rho]
        load_keys = ("preload", "hardness", "plastic")
        loads = [{key: getattr(load, key) for key in load_keys} for load in contacts]
        return {"radii": radii, "loads": loads, "ranges": ranges}

    def filter_settings(self, purpose: str) -> dict[str, Any]:
        """Return the settings of masters and filters on both sides, and contacts along a side."""
        configuration = self._configuration
        section, count_key = ("sets", "sets.count")
        if purpose in ("scales", "sampled"):
            section, count_key = ("scales", "contact.count")
        sides = {
            side: {
                name: get_key(configuration, key)
                for name, key in master_keys(configuration, section, side).items()
            }
            for side in SIDES
        }
        if purpose == "enhancement":
            del sides["large"]
        return {"contacts_per_side": get_key(configuration, count_key), "sides": sides}

    def _grid_names(self, purpose: str) -> dict[str, str]:
        """Return radii, loads and ranges of a grid as parts of paths."""
        grid = self.contact_grid(purpose)
        return {
            "radii": "+".join(f"R{path_token(radius, 'um')}" for radius in grid["radii"]),
            "loads": "+".join(replace(self.contact, **load).load for load in grid["loads"]),
            "ranges": "+".join(f"rho{path_token(rho, 'nm')}" for rho in grid["ranges"]),
        }

    def _masters_of(self, purpose: str, surface: str, realizations: int) -> list[FilteredMasters]:
        """Return the files of the first realizations of the masters of a surface."""
        step = 1 if purpose in ("scales", "sampled") else MASTERS_CHUNK
        probe = "smooth" if purpose == "scaling" else self._probe
        if surface in self.combined_surfaces:
            probe = "combined"
        names = self._grid_names(purpose)
        settings = short_digest([self.filter_settings(purpose), self._filter_values])
        return [
            FilteredMasters(purpose, settings, surface, probe, *chunk, **names)
            for chunk in _chunks(realizations, step)
        ]

    def filtered_masters(self, purpose: str = "scales") -> list[FilteredMasters]:
        """Return the masters of a purpose, those for scaling on a smooth sphere.

        Spectra are sampled only for measured surfaces.
        """
        surfaces = self._selection.substrates
        if purpose == "sampled":
            surfaces = [name for name in surfaces if self._selection.basis[name] == "measured"]
        sections = {"sets": "sets", "scaling": "scaling", "enhancement": "scaling"}
        section = sections.get(purpose, "scales")
        count = self._configuration[section]["realizations"]
        return [row for surface in surfaces for row in self._masters_of(purpose, surface, count)]

    def master_sources(self, row: Any) -> dict[str, list[str]]:
        """Return the master files of a row of the study, or scans and spectra of another row."""
        realizations = range(int(row.first), int(row.last) + 1)
        surface = row.surface
        if row.purpose == "scales":
            return {
                f"{side}_masters": [
                    self.path(self._patterns.master, surface, realization=realization, side=side)
                    for realization in realizations
                ]
                for side in SIDES
            }
        spectra = [self.spectrum(surface) for _ in realizations]
        if row.purpose == "sampled":
            pattern = self._patterns.sampled_spectrum
            if surface in self.combined_surfaces:
                pattern = self._patterns.both_sampled_spectrum
            spectra = [self.path(pattern, surface, realization=number) for number in realizations]
        return {
            "scans": [
                self.stitched_of_realization(surface, number, row.purpose != "sampled")
                for number in realizations
            ],
            "spectra": spectra,
        }
