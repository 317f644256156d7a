"""Every file of one study: those of each surface, pair of scans, realization and variant."""

from collections import namedtuple
from collections.abc import Iterable, Mapping
from functools import cached_property
from itertools import cycle, product
from typing import Any, TypeVar

from hardcontact.config.patterns import STUDY_VARIANT, Patterns
from hardcontact.config.selection import Selection
from hardcontact.config.variants import Variant, study_contact, surface_variants, variants
from hardcontact.numbers.units import token
from hardcontact.surfaces.synthesis import SIDES

Key = TypeVar("Key")
#: Scans of a pool in one job: more of them leave the jobs there are as they are.
CHUNK = 15


# Rows of lists: their fields are wildcards of patterns.
Scan = namedtuple("Scan", "surface scan")
Pair = namedtuple("Pair", "surface scan sphere_scan")
Chunk = namedtuple("Chunk", "surface first last")
Master = namedtuple("Master", "surface realization side")
ScaledMaster = namedtuple("ScaledMaster", "surface scan side")
VariedMaster = namedtuple("VariedMaster", "surface variant realization side probe")


def _grouped(pairs: Iterable[tuple[Key, str]]) -> dict[Key, list[str]]:
    """Return the second of pairs that have the same first, by the first."""
    groups: dict[Key, list[str]] = {}
    for key, name in pairs:
        groups.setdefault(key, []).append(name)
    return groups


class Files:
    """The files of one study, with its load and its ways to make substitutes, by name.

    Lists are of rows whose fields are wildcards of patterns: `paths` gives the files.
    """

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        self._configuration, self._selection = configuration, selection
        self._patterns = patterns
        self.contact = study_contact(configuration)
        self._swept = {
            "radius": f"R{token(configuration['sphere']['radius'], 'um')}",
            "load": self.contact.load,
            "range": f"rho{token(configuration['scales']['range'], 'nm')}",
        }
        self.surface_variants = surface_variants(configuration)

    @cached_property
    def variants(self) -> list[Variant]:
        """The variants of robustness, the study itself first."""
        return variants(self._configuration, self._selection)

    def path(self, pattern: str, surface: str, **wildcards: object) -> str:
        """Return the path of a pattern for a surface; the study has the values not given."""
        sphere = surface == self._selection.sphere
        shape = f"sphere-{self._swept['radius']}" if sphere else "flat"
        of_study = {"variant": STUDY_VARIANT, "shape": shape, **self._swept}
        return pattern.format(surface=surface, **of_study | wildcards)

    def paths(self, pattern: str, rows: Iterable[Any]) -> list[str]:
        """Return the files of a pattern, one a row."""
        return [self.path(pattern, **row._asdict()) for row in rows]

    # Surfaces

    def spectrum(self, surface: str, variant: str = STUDY_VARIANT) -> str:
        """Return the spectrum of a surface at all scales."""
        measured = self._selection.basis[surface] == "measured"
        patterns, made = self._patterns, self.surface_variants[variant].spectrum
        pattern = patterns.measured_spectrum if measured else patterns.calibrated_spectrum
        return self.path(pattern, surface, variant=made)

    def measurements(self, surface: str) -> list[str]:
        """Return every scan of a measured surface as its file was read; none of a substitute."""
        if self._selection.basis[surface] != "measured":
            return []
        return [
            self.path(self._patterns.measurement, surface, scan=measured.scan)
            for measured in self._selection.measured(surface)
        ]

    def levelling(self, surface: str) -> dict[str, Any]:
        """Return how the scans of a surface are levelled, with the radius (nm) of a sphere."""
        radius = self._configuration["sphere"]["radius"]
        return {
            "levelling": self._configuration["scan"]["levelling"],
            "sphere_radius": radius if surface == self._selection.sphere else None,
        }

    def measuring(self, surface: str) -> dict[str, Any]:
        """Return how the measurements of a surface become its spectrum, with the tips (nm)."""
        radii = [measured.tip_radius for measured in self._selection.measured(surface)]
        return {"tip_radii": radii, **self.levelling(surface)}

    def conditioning(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return what a substitute scan shares with the others of its group."""
        group, made = self._selection.group(surface, scan), self.surface_variants[variant].spectrum
        return self.path(self._patterns.conditioning, surface, variant=made, group=group)

    @property
    def conditionings(self) -> dict[str, str]:
        """What the study's own scans of each substitute share, by surface."""
        return {
            surface: self.conditioning(surface, self._selection.scans(surface)[0])
            for surface, basis in self._selection.basis.items()
            if basis == "substitute"
        }

    @property
    def scan_groups(self) -> dict[tuple[int, ...], list[str]]:
        """The numbers of scans that are made together, and the substitutes that have such scans."""
        most = max(self._configuration[key]["realizations"] for key in ("sets", "robustness"))
        selection = self._selection
        return _grouped(
            (tuple(selection.scans_of_group(surface, group)), surface)
            for surface in self.conditionings
            for group in range(selection.group(surface, selection.own_scan(surface, most)) + 1)
        )

    def stitched(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return a levelled scan with its mirror images."""
        return self.path(self._patterns.stitched, surface, variant=variant, scan=scan)

    def stitched_of_realization(self, surface: str, realization: int, variant: str) -> str:
        """Return the scan that a realization builds on, in turn where there are fewer scans."""
        scans = self._selection.scans(surface)
        return self.stitched(surface, scans[(realization - 1) % len(scans)], variant)

    def stitched_of_set_realization(self, surface: str, realization: int, variant: str) -> str:
        """Return the scan that a realization of the sets builds on.

        Of a substitute it is a scan of its own, beyond the study's where these are used up; of a
        measured surface it is that of `stitched_of_realization`.
        """
        if self._selection.basis[surface] == "measured":
            return self.stitched_of_realization(surface, realization, variant)
        return self.stitched(surface, self._selection.own_scan(surface, realization), variant)

    @property
    def first_sphere(self) -> str:
        """The scan of the sphere that roughens the sphere of all masters."""
        sphere = self._selection.sphere
        return self.stitched(sphere, self._selection.scans(sphere)[0])

    # Scans

    @property
    def scans(self) -> list[Scan]:
        """Every scan."""
        return self._first_scans(self._selection.surfaces)

    @property
    def substrate_scans(self) -> list[Scan]:
        """Every scan of a substrate."""
        return self._first_scans(self._selection.substrates)

    @property
    def realized_scans(self) -> list[Scan]:
        """The first scans of every substrate, one a realization of the chapter of insight."""
        count = self._configuration["insight"]["realizations"]
        return self._first_scans(self._selection.substrates, count)

    def _first_scans(self, surfaces: Iterable[str], count: int | None = None) -> list[Scan]:
        """Return the first so many scans of surfaces, or all."""
        return [
            Scan(surface, scan)
            for surface in surfaces
            for scan in self._selection.scans(surface)[:count]
        ]

    @property
    def pairs_in_turn(self) -> list[Pair]:
        """One scan of the sphere for each scan of a substrate, in turn."""
        return [
            Pair(surface, scan, sphere_scan)
            for surface in self._selection.substrates
            for scan, sphere_scan in zip(
                self._selection.scans(surface), cycle(self._selection.sphere_scans), strict=False
            )
        ]

    @property
    def indent_pairs(self) -> list[tuple[int, int]]:
        """Scan of the indented surface and of the sphere, every pair."""
        scans = self._selection.scans(self._configuration["indent"]["surface"])
        return list(product(scans, self._selection.sphere_scans))

    @property
    def repeated_pairs(self) -> list[tuple[int, int]]:
        """Scan of the indented surface and of the sphere in repeated contact, the first pairs."""
        surface = self._configuration["indent"]["surface"]
        count = self._configuration["insight"]["realizations"]
        pairs = [pair for pair in self.pairs_in_turn if pair.surface == surface]
        return [(pair.scan, pair.sphere_scan) for pair in pairs[:count]]

    @property
    def chunks(self) -> list[Chunk]:
        """The scans of all pools, from the first to the last of those computed together."""
        pool = self._configuration["sets"]["pool"]
        return [
            Chunk(surface, first, min(first + CHUNK - 1, pool))
            for surface in self._selection.pooled
            for first in range(1, pool + 1, CHUNK)
        ]

    # Masters

    @property
    def masters(self) -> list[Master]:
        """Every master of the study."""
        realizations = range(1, self._configuration["scales"]["realizations"] + 1)
        return [Master(*one) for one in product(self._selection.substrates, realizations, SIDES)]

    @property
    def measured_masters(self) -> list[Master]:
        """Every master of a measured surface: its spectrum can be drawn."""
        basis = self._selection.basis
        return [one for one in self.masters if basis[one.surface] == "measured"]

    @property
    def scaled_masters(self) -> list[ScaledMaster]:
        """Every master at several spheres, ranges and areas."""
        return [
            ScaledMaster(scan.surface, scan.scan, side)
            for scan, side in product(self.realized_scans, SIDES)
        ]

    @property
    def varied_surfaces(self) -> list[tuple[str, str]]:
        """Every surface and variant of it that some variant of the study asks for."""
        made = (item for variant in self.variants for item in variant.variant.items())
        return list(dict.fromkeys(made))

    @property
    def varied_together(self) -> dict[tuple[str, ...], list[str]]:
        """The surfaces whose masters are filtered together, and the variants they have these of."""
        of_variants = _grouped((variant, surface) for surface, variant in self.varied_surfaces)
        return _grouped((tuple(surfaces), variant) for variant, surfaces in of_variants.items())

    @property
    def set_masters(self) -> list[VariedMaster]:
        """Every master that the bands of sets are drawn from."""
        return self._varied_masters(self.variants[:1], "sets")

    @property
    def varied_masters(self) -> list[VariedMaster]:
        """Every master that some variant asks for."""
        return self._varied_masters(self.variants, "robustness")

    def _varied_masters(self, wanted: Iterable[Variant], section: str) -> list[VariedMaster]:
        """Return each master of these variants once, in as many realizations as a section has."""
        realizations = range(1, self._configuration[section]["realizations"] + 1)
        masters = (
            VariedMaster(surface, name, realization, side, variant.probe)
            for variant in wanted
            for surface, name in variant.variant.items()
            for realization, side in product(realizations, SIDES)
        )
        return list(dict.fromkeys(masters))

    def loads(self, probe: str) -> list[dict[str, float]]:
        """Return preload (N) and hardness (Pa) of the contacts that this sphere comes with."""
        contacts = [variant.contact for variant in self.variants if variant.probe == probe]
        different = {contact.load: contact for contact in contacts}.values()
        return [{"preload": contact.preload, "hardness": contact.hardness} for contact in different]
