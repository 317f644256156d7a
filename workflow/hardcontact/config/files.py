"""Every file of one study: for each surface, pair of scans and realization."""

from collections import defaultdict, namedtuple
from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import cycle
from math import ceil, sqrt
from typing import Any

from hardcontact.base.units import path_token
from hardcontact.config.configuration import (
    combines_bodies,
    get_key,
    master_keys,
    study_contact,
)
from hardcontact.config.patterns import SCAN_KEYS, SMOOTH, Patterns, key_values, short_digest
from hardcontact.config.selection import Selection
from hardcontact.surfaces.features import GAUSSIAN, SIGNS
from hardcontact.surfaces.synthesis import SIDES

#: Scans of a pool, realizations of masters (not those of the scales), and draws of surfaces with
#: features in one job. A trade: long beside the half second in which a job starts, and enough
#: jobs to share out among cores. Jobs stay as they are if a study has more of them.
CHUNK = 15
MASTERS_CHUNK = 5
DRAWS_CHUNK = 10
#: Places on a rough sphere at which own surfaces touch it, the fewest. A trade: an interval from 16
#: places is 1.1 times as wide as from many, and each place costs the force sums of its contacts.
SPHERE_PLACES = 16
#: Contacts along a side at each of several places.
CONTACTS_A_PLACE = 6
#: A range of adhesion (nm) that is much shorter than the published range.
SHORT_RANGE = 1.0
#: The shortest range of adhesion (nm) on whole surfaces. They may rise several hundred shorter
#: ranges above a contact, more than the exponential of a floating-point number holds.
SHORTEST_WHOLE_RANGE = 0.7
#: Loads of the scaling relative to the preload. An eighth makes the side of the contact 2.8 times
#: shorter and leaves some 30 pixels; larger loads move short edges beyond the cutoffs of the sets.
PRELOAD_SHARES = (1 / 8, 1)

# Rows of lists: their fields are wildcards of patterns.
Scan = namedtuple("Scan", "surface scan")
ScanPair = namedtuple("ScanPair", "surface scan sphere_scan")
Chunk = namedtuple("Chunk", "surface first last")
DrawChunk = namedtuple("DrawChunk", "surface features first last")
FilteredMasters = namedtuple(
    "FilteredMasters", "purpose settings surface probe first last radii loads ranges"
)


def _chunks(count: int, step: int) -> list[tuple[int, int]]:
    """Return the first and the last of each chunk of the numbers from 1 to a count."""
    return [(start, min(start + step - 1, count)) for start in range(1, count + 1, step)]


class Files:
    """The files of one study, with its load.

    Lists are of rows whose fields are wildcards of patterns: `paths` gives the files.
    """

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        self._configuration = configuration
        self._selection = selection
        self._patterns = patterns
        self.contact = study_contact(configuration)
        self._swept = {
            "radius": f"R{path_token(configuration['sphere']['radius'], 'um')}",
            "load": self.contact.load,
            "range": f"rho{path_token(configuration['scales']['range'], 'nm')}",
        }
        self._sphere_sources = selection.sources.get(selection.sphere, SMOOTH)
        keys = (*SCAN_KEYS, "contact.window", "sphere.surface")
        self._filter_values = key_values(configuration, keys)
        self._combines_bodies = combines_bodies(configuration)
        is_rough = configuration["scales"]["sphere_roughness"]
        self._probe = "rough" if is_rough else "smooth"
        if is_rough or self._combines_bodies:
            self._filter_values["sphere"] = self._sphere_sources

    def path(self, pattern: str, surface: str, **wildcards: object) -> str:
        """Return the path of a pattern for a surface; wildcards default to values of the study."""
        sphere = surface == self._selection.sphere
        shape = f"sphere-{self._swept['radius']}" if sphere else "flat"
        sources = {
            "sources": self._selection.sources[surface],
            "sphere_sources": self._sphere_sources,
        }
        defaults = {"shape": shape, **sources, **self._swept}
        return pattern.format(surface=surface, **defaults | wildcards)

    def paths(self, pattern: str, rows: Iterable[Any]) -> list[str]:
        """Return the files of a pattern, one a row."""
        return [self.path(pattern, **row._asdict()) for row in rows]

    # Surfaces

    def spectrum(self, surface: str) -> str:
        """Return the spectrum of a surface at all scales."""
        is_measured = self._selection.basis[surface] == "measured"
        patterns = self._patterns
        pattern = patterns.measured_spectrum if is_measured else patterns.calibrated_spectrum
        return self.path(pattern, surface)

    def measurements(self, surface: str) -> list[str]:
        """Return the files of all scans of a measured surface; an empty list for a substitute."""
        if self._selection.basis[surface] != "measured":
            return []
        scans = self._selection.all_scans(surface)
        return [self.path(self._patterns.measurement, surface, scan=scan) for scan in scans]

    def levelling(self, surface: str) -> dict[str, Any]:
        """Return the levelling of the scans of a surface, with the radius (nm) of a sphere."""
        radius = self._configuration["sphere"]["radius"]
        return {
            "levelling": self._configuration["scan"]["levelling"],
            "sphere_radius": radius if surface == self._selection.sphere else None,
        }

    def measuring(self, surface: str) -> dict[str, Any]:
        """Return the levelling and the tip radii (nm) of the measurements of a surface."""
        return {"tip_radii": self._selection.tip_radii(surface), **self.levelling(surface)}

    def conditioning(self, surface: str, scan: int) -> str:
        """Return the gain and factors that a substitute scan shares with its group."""
        group = self._selection.group(surface, scan)
        first_scan = self._selection.scans_of_group(surface, group)[0]
        return self.path(self._patterns.conditioning, surface, scan=first_scan)

    @property
    def conditionings(self) -> dict[str, str]:
        """The conditioning of the study's own scans of each substitute, by surface."""
        return {
            surface: self.conditioning(surface, self._selection.scans(surface)[0])
            for surface, basis in self._selection.basis.items()
            if basis == "substitute"
        }

    @property
    def scan_groups(self) -> dict[tuple[int, ...], list[str]]:
        """The numbers of scans that are made together, and the substitutes that have such scans."""
        realizations = max(self._configuration[key]["realizations"] for key in ("sets", "scaling"))
        selection = self._selection
        groups = defaultdict[tuple[int, ...], list[str]](list)
        for surface in self.conditionings:
            last_group = selection.group(surface, selection.own_scan(surface, realizations))
            for group in range(last_group + 1):
                groups[tuple(selection.scans_of_group(surface, group))].append(surface)
        return groups

    def stitched(self, surface: str, scan: int) -> str:
        """Return a levelled scan with its mirror images."""
        return self.path(self._patterns.stitched, surface, scan=scan)

    def stitched_of_realization(
        self, surface: str, realization: int, own_scans: bool = False
    ) -> str:
        """Return the scan that a realization builds on, in turn where there are fewer scans.

        Realizations of the sets have scans of their own if the surface is a substitute.
        """
        scans = self._selection.scans(surface)
        scan = scans[(realization - 1) % len(scans)]
        if own_scans and self._selection.basis[surface] == "substitute":
            scan = self._selection.own_scan(surface, realization)
        return self.roughness(surface, scan)

    @property
    def first_sphere(self) -> str:
        """The scan of the sphere that roughens the sphere of all masters."""
        sphere = self._selection.sphere
        return self.stitched(sphere, self._selection.scans(sphere)[0])

    # Both bodies

    @property
    def combined_surfaces(self) -> list[str]:
        """The measured substrates to whose roughness that of a measured sphere is added."""
        basis = self._selection.basis
        if not self._combines_bodies or basis[self._selection.sphere] != "measured":
            return []
        return [name for name in self._selection.substrates if basis[name] == "measured"]

    def rough_bodies(self, surface: str) -> list[str]:
        """Return the surfaces whose roughness is in a map of a substrate."""
        is_combined = surface in self.combined_surfaces
        return [surface, self._selection.sphere] if is_combined else [surface]

    def roughness(self, surface: str, scan: int) -> str:
        """Return the stitched scan of a substrate, with the sphere's roughness if that is added."""
        if surface not in self.combined_surfaces:
            return self.stitched(surface, scan)
        return self.path(self._patterns.both_stitched, surface, scan=scan)

    def roughness_spectrum(self, surface: str) -> str:
        """Return the spectrum of a surface, with the sphere's if its roughness is added."""
        if surface not in self.combined_surfaces:
            return self.spectrum(surface)
        return self.path(self._patterns.both_spectrum, surface)

    def sphere_scan(self, surface: str, scan: int) -> int:
        """Return the scan of the sphere that meets a scan of a substrate, in turn."""
        pairs = {pair[:2]: pair.sphere_scan for pair in self.pairs_in_turn}
        return int(pairs[surface, scan])

    def measurements_of_map(self, surface: str, scan: int) -> list[int]:
        """Return the measurements of the spectrum of a surface that show a map of its roughness."""
        scans = self._selection.all_scans(surface)
        numbers = [scans.index(scan)]
        if surface in self.combined_surfaces:
            sphere_scans = self._selection.all_scans(self._selection.sphere)
            numbers.append(len(scans) + sphere_scans.index(self.sphere_scan(surface, scan)))
        return numbers

    @property
    def places_per_side(self) -> int:
        """Places along a side of each scan of the sphere at which it touches, of own surfaces."""
        if not self._combines_bodies:
            return 1
        return ceil(sqrt(SPHERE_PLACES / len(self._selection.sphere_scans)))

    @property
    def sphere_places(self) -> list[int]:
        """The numbers of the places on the sphere: those of its scans if each has one."""
        if self.places_per_side == 1:
            return self._selection.sphere_scans
        count = len(self._selection.sphere_scans) * self.places_per_side**2
        return list(range(1, count + 1))

    @property
    def contacts_a_place(self) -> int:
        """Contacts along a side of their array at each place on the sphere."""
        count = int(self._configuration["contact"]["count"])
        return count if self.places_per_side == 1 else min(count, CONTACTS_A_PLACE)

    # Scans

    @property
    def scans(self) -> list[Scan]:
        """Every scan."""
        return self._scans_of(self._selection.surfaces)

    @property
    def substrate_scans(self) -> list[Scan]:
        """Every scan of a substrate."""
        return self._scans_of(self._selection.substrates)

    def _scans_of(self, surfaces: Iterable[str]) -> list[Scan]:
        """Return every scan of surfaces."""
        scans = self._selection.scans
        return [Scan(surface, scan) for surface in surfaces for scan in scans(surface)]

    @property
    def pairs_in_turn(self) -> list[ScanPair]:
        """One scan of the sphere for each scan of a substrate, in turn."""
        return [
            ScanPair(surface, scan, sphere_scan)
            for surface in self._selection.substrates
            for scan, sphere_scan in zip(
                self._selection.scans(surface), cycle(self._selection.sphere_scans), strict=False
            )
        ]

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
    def substitutes(self) -> list[str]:
        """The substitute substrates."""
        basis = self._selection.basis
        return [name for name in self._selection.substrates if basis[name] == "substitute"]

    @property
    def measured_scans(self) -> list[Scan]:
        """Every scan of a measured substrate."""
        return [scan for scan in self.substrate_scans if scan.surface not in self.substitutes]

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
        contacts, radii, ranges = [contact], [contact.radius], [contact.range]
        if purpose == "scaling":
            preloads = [share * contact.preload for share in PRELOAD_SHARES]
            contacts = [replace(contact, preload=preload) for preload in preloads]
            radii = self._configuration["scaling"]["radii"]
        elif purpose == "enhancement":
            contacts = [contact, replace(contact, plastic=False)]
            ranges = [SHORT_RANGE, contact.range]
        load_keys = ("preload", "hardness", "plastic")
        loads = [{key: getattr(load, key) for key in load_keys} for load in contacts]
        return {"radii": radii, "loads": loads, "ranges": ranges}

    def filters(self, purpose: str) -> dict[str, Any]:
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
        settings = short_digest([self.filters(purpose), self._filter_values])
        return [
            FilteredMasters(purpose, settings, surface, probe, *chunk, **names)
            for chunk in _chunks(realizations, step)
        ]

    def masters(self, purpose: str = "scales") -> list[FilteredMasters]:
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
