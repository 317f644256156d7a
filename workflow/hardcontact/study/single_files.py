"""The paths of single files of one study: spectra, scans, stitched scans."""

from collections.abc import Mapping
from typing import Any

from hardcontact.study.patterns import STUDY_VARIANT, Patterns
from hardcontact.study.selection import NO_SCAN, Selection
from hardcontact.study.units import token
from hardcontact.study.variants import SurfaceVariant, named_load, surface_variants

__all__ = ["SingleFiles"]


class SingleFiles:
    """The files of one study, one by one.

    Parameters
    ----------
    configuration : dict
        With its quantities as the texts that the user wrote: they stand in paths.
    selection : Selection
        Surfaces and scans of the study.
    patterns : Patterns
        Paths of the study.
    """

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        self._selection = selection
        self._patterns = patterns
        contact, scales = configuration["contact"], configuration["scales"]
        self._swept = {
            "radius": f"R{token(configuration['sphere']['radius'], 'um')}",
            "load": named_load(contact["preload"], contact["hardness"])["name"],
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

    def scan(self, surface: str, scan: int, variant: str = STUDY_VARIANT) -> str:
        """Return the file that a scan is read from, measured or a substitute."""
        if self._selection.basis[surface] == "measured":
            return self._selection.path(surface, scan)
        return self._of_surface(self._patterns.substitute, surface, variant, scan=scan)

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
