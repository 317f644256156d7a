"""Every file of one study: those of each surface, pair of scans, realization and variant."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from itertools import cycle, product
from typing import Any, NamedTuple

from hardcontact.config.patterns import STUDY_VARIANT, Patterns
from hardcontact.config.selection import NO_SCAN, Selection
from hardcontact.config.variants import (
    SurfaceVariant,
    Variant,
    named_load,
    surface_variants,
    variants,
)
from hardcontact.contact.bearing_area import NamedLoad
from hardcontact.numbers.units import token
from hardcontact.surfaces.synthesis import SIDES


class SingleFiles:
    """The files of one study, one by one, with its load and its ways to make substitutes, by name.

    Quantities of the configuration are the texts that the user wrote: they stand in paths.
    """

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        self._selection = selection
        self._patterns = patterns
        contact, scales = configuration["contact"], configuration["scales"]
        self.load = named_load(contact["preload"], contact["hardness"])
        self._swept = {
            "radius": f"R{token(configuration['sphere']['radius'], 'um')}",
            "load": self.load["name"],
            "range": f"rho{token(scales['range'], 'nm')}",
        }
        self.surface_variants: dict[str, SurfaceVariant] = surface_variants(configuration)

    def spectrum(self, surface: str, variant: str = STUDY_VARIANT) -> str:
        """Return the spectrum of a surface at all scales."""
        if self._selection.basis[surface] == "measured":
            pattern = self._patterns.measured_spectrum
        else:
            pattern = self._patterns.calibrated_spectrum
        return self._of_surface(pattern, surface, self.surface_variants[variant].spectrum)

    def conditioning(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return what a substitute scan shares with the others of its group."""
        group, made = self._selection.group(surface, scan), self.surface_variants[variant].spectrum
        return self._of_surface(self._patterns.conditioning, surface, made, group=group)

    def levelled(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return a levelled scan."""
        return self._of_surface(self._patterns.levelled, surface, variant, scan=scan)

    def stitched(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return a levelled scan with its mirror images."""
        return self._of_surface(self._patterns.stitched, surface, variant, scan=scan)

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

    def sphere(self, sphere_scan: int) -> str | list[str]:
        """Return the stitched scan of the sphere as the input of a rule: none of a smooth one."""
        if sphere_scan == NO_SCAN:
            return []
        return self.stitched(self._selection.sphere, sphere_scan)

    @property
    def first_sphere(self) -> str:
        """The scan of the sphere that roughens the sphere of all masters."""
        sphere = self._selection.sphere
        return self.stitched(sphere, self._selection.scans(sphere)[0])

    def _of_surface(self, pattern: str, surface: str, variant: str, **wildcards: object) -> str:
        """Return the path of a pattern for a surface and the swept values of the study."""
        sphere = surface == self._selection.sphere
        shape = f"sphere-{self._swept['radius']}" if sphere else "flat"
        return pattern.format(
            surface=surface, variant=variant, shape=shape, **self._swept, **wildcards
        )


#: Scans of a pool in one job: more of them leave the jobs there are as they are.
CHUNK = 15


class Pair(NamedTuple):
    """One scan of a substrate and one of the sphere."""

    surface: str
    variant: str
    scan: int
    sphere_scan: int


class Chunk(NamedTuple):
    """Scans of the pool of a substrate that are computed together, from the first to the last."""

    surface: str
    first: int
    last: int


class Master(NamedTuple):
    """One realization of a surface at all scales, filtered from one side, on one sphere."""

    surface: str
    variant: str
    realization: int
    side: str
    probe: str


class Files(SingleFiles):
    """The files of one study, one by one and in lists; parameters as those of `SingleFiles`."""

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        super().__init__(configuration, selection, patterns)
        self._configuration = configuration
        self.realizations = range(1, configuration["scales"]["realizations"] + 1)

    @cached_property
    def variants(self) -> list[Variant]:
        """The variants of robustness, the study itself first."""
        return variants(self._configuration, self._selection)

    # Topography

    @property
    def scans(self) -> list[tuple[str, int]]:
        """Surface and number of every scan."""
        return [(name, scan) for name in self._selection.surfaces for scan in self._scans(name)]

    @property
    def scan_groups(self) -> dict[tuple[int, ...], list[str]]:
        """The numbers of scans that are made together, and the substitutes that have such scans."""
        most = max(self._configuration[key]["realizations"] for key in ("sets", "robustness"))
        groups: dict[tuple[int, ...], list[str]] = {}
        for surface in self.conditionings:
            last = self._selection.group(surface, self._selection.own_scan(surface, most))
            for group in range(last + 1):
                scans = tuple(self._selection.scans_of_group(surface, group))
                groups.setdefault(scans, []).append(surface)
        return groups

    @property
    def levelled_scans(self) -> list[str]:
        """Every levelled scan."""
        return [self.levelled(surface, scan) for surface, scan in self.scans]

    @property
    def spectra(self) -> list[str]:
        """The spectrum of every surface."""
        return [self.spectrum(surface) for surface in self._selection.surfaces]

    @property
    def conditionings(self) -> dict[str, str]:
        """What the study's own scans of each substitute share, by surface."""
        return {
            surface: self.conditioning(surface, self._scans(surface)[0])
            for surface in self._selection.surfaces
            if self._selection.basis[surface] == "substitute"
        }

    # Adhesion and contact

    @property
    def pairs_in_turn(self) -> list[Pair]:
        """One scan of the sphere for each scan of a substrate, in turn."""
        return [
            Pair(surface, STUDY_VARIANT, scan, sphere_scan)
            for surface in self._selection.substrates
            for scan, sphere_scan in zip(
                self._scans(surface), cycle(self._selection.sphere_scans), strict=False
            )
        ]

    def of_pairs(self, pattern: str, pairs: Iterable[Pair]) -> list[str]:
        """Return the files of a pattern, one a pair."""
        return [pattern.format(**pair._asdict(), **self._swept) for pair in pairs]

    @property
    def stitched_spheres(self) -> list[str]:
        """Every scan of the sphere with its mirror images; none of a smooth one."""
        sphere = self._selection.sphere
        return [self.stitched(sphere, scan) for scan in self._scans(sphere)]

    @property
    def substrate_scans(self) -> list[tuple[str, int]]:
        """Surface and number of every scan of a substrate."""
        return [
            (surface, scan) for surface, scan in self.scans if surface != self._selection.sphere
        ]

    @property
    def pull_offs(self) -> list[str]:
        """The pull-off forces of every scan of a substrate."""
        pattern = self._patterns.pull_off
        return [
            self._of_surface(pattern, surface, STUDY_VARIANT, scan=scan)
            for surface, scan in self.substrate_scans
        ]

    @property
    def indent_pairs(self) -> list[tuple[int, int]]:
        """Scan of the indented surface and of the sphere, every pair."""
        scans = self._scans(self._configuration["indent"]["surface"])
        return list(product(scans, self._selection.sphere_scans))

    # Scales

    @property
    def masters(self) -> list[tuple[str, int, str]]:
        """Surface, realization and side of every master of the study."""
        return [
            (surface, realization, side)
            for surface in self._selection.substrates
            for realization in self.realizations
            for side in SIDES
        ]

    @property
    def filtered_pull_offs(self) -> list[str]:
        """The pull-off forces of every master at all cutoffs."""
        pattern = self._patterns.filtered_pull_off
        return [
            self._of_surface(pattern, surface, STUDY_VARIANT, realization=realization, side=side)
            for surface, realization, side in self.masters
        ]

    # Sets

    @property
    def chunks(self) -> list[Chunk]:
        """The scans of all pools."""
        pool = self._configuration["sets"]["pool"]
        return [
            Chunk(surface, first, min(first + CHUNK - 1, pool))
            for surface in self._selection.pooled
            for first in range(1, pool + 1, CHUNK)
        ]

    @property
    def pools(self) -> list[str]:
        """The forces of all pools, one file a chunk."""
        return [
            self._of_surface(
                self._patterns.pool, one.surface, STUDY_VARIANT, first=one.first, last=one.last
            )
            for one in self.chunks
        ]

    @property
    def smooth_spheres(self) -> list[str]:
        """The forces on a smooth sphere of the study's scans of each substrate with a pool."""
        pattern = self._patterns.smooth_sphere
        return [
            self._of_surface(pattern, surface, STUDY_VARIANT) for surface in self._selection.pooled
        ]

    @property
    def set_masters(self) -> list[Master]:
        """Every master that the bands of sets are drawn from."""
        probe = self.variants[0].probe
        return [
            Master(surface, STUDY_VARIANT, realization, side, probe)
            for surface in self._selection.substrates
            for realization in range(1, self._configuration["sets"]["realizations"] + 1)
            for side in SIDES
        ]

    @property
    def set_scales(self) -> list[str]:
        """The pull-off forces of every master of the sets."""
        return self.of_masters(self.set_masters)

    # Robustness

    @cached_property
    def varied_surfaces(self) -> list[tuple[str, str]]:
        """Every surface and variant of it that some variant asks for."""
        made = (item for variant in self.variants for item in variant.variant.items())
        return list(dict.fromkeys(made))

    @property
    def varied_adhesion(self) -> list[str]:
        """The mean forces of the scans of these, one file a surface and variant."""
        pattern = self._patterns.varied_adhesion
        return [self._of_surface(pattern, *of_surface) for of_surface in self.varied_surfaces]

    @property
    def varied_together(self) -> dict[tuple[str, ...], list[str]]:
        """The surfaces whose masters are filtered together, and the variants they have these of."""
        of_variants: dict[str, list[str]] = {}
        for surface, variant in self.varied_surfaces:
            of_variants.setdefault(variant, []).append(surface)
        together: dict[tuple[str, ...], list[str]] = {}
        for variant, surfaces in of_variants.items():
            together.setdefault(tuple(surfaces), []).append(variant)
        return together

    @cached_property
    def varied_masters(self) -> list[Master]:
        """Every master that some variant asks for."""
        masters = (
            Master(surface, name, realization, side, variant.probe)
            for variant in self.variants
            for surface, name in variant.variant.items()
            for realization in range(1, self._configuration["robustness"]["realizations"] + 1)
            for side in SIDES
        )
        return list(dict.fromkeys(masters))

    @property
    def varied_scales(self) -> list[str]:
        """The pull-off forces of every master of robustness."""
        return self.of_masters(self.varied_masters)

    def of_masters(self, masters: Iterable[Master]) -> list[str]:
        """Return the pull-off forces of masters at all cutoffs and loads, one file a master."""
        pattern = self._patterns.varied_scales
        return [pattern.format(**one._asdict(), **self._swept) for one in masters]

    def loads(self, probe: str) -> list[NamedLoad]:
        """Return the loads that this sphere comes with, each once."""
        variants = [variant for variant in self.variants if variant.probe == probe]
        return list({variant.load["name"]: variant.load for variant in variants}.values())

    # How they are made

    def _scans(self, surface: str) -> list[int]:
        return self._selection.scans(surface)
