"""The paths of spectra and scans of the surfaces of one study, and of both bodies together."""

from collections.abc import Iterable
from typing import Any

from hardcontact.base.units import path_token
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.patterns import StorePatterns


class SurfaceFiles:
    """The paths of spectra and scans of the surfaces of one study."""

    def __init__(self, plan: StudyPlan) -> None:
        self.plan = plan
        self.selection = plan.selection
        self.patterns = StorePatterns(plan)
        self._defaults = {
            "radius": f"R{path_token(plan.contact.radius, 'um')}",
            "loading": plan.contact.loading_name,
            "rho": f"rho{path_token(plan.contact.rho, 'nm')}",
            "sphere_digest": self.selection.sphere_digest,
        }

    def path(self, pattern: str, surface: str, **wildcards: object) -> str:
        """Return the path of a pattern for a surface; wildcards default to values of the study."""
        is_sphere = surface == self.selection.sphere
        surface_values = {
            "shape": f"sphere-{self._defaults['radius']}" if is_sphere else "flat",
            "digest": self.selection.digests[surface],
        }
        return pattern.format(surface=surface, **self._defaults | surface_values | wildcards)

    def paths(self, pattern: str, rows: Iterable[Any]) -> list[str]:
        """Return the paths of a pattern, one for each row, whose fields are its wildcards."""
        return [self.path(pattern, **row._asdict()) for row in rows]

    # Surfaces

    def spectrum_path(self, surface: str) -> str:
        """Return the path of the spectrum of a surface at all scales."""
        if surface in self.selection.measured_surfaces:
            return self.path(self.patterns.measured_spectra, surface)
        return self.path(self.patterns.calibrated_spectra, surface)

    def measurement_paths(self, surface: str) -> list[str]:
        """Return the paths of all scans of a measured surface; none for a substitute."""
        if surface not in self.selection.measured_surfaces:
            return []
        scans = self.selection.all_scans(surface)
        return [self.path(self.patterns.measurements, surface, scan=scan) for scan in scans]

    def conditioning_path(self, surface: str) -> str:
        """Return the path of the gain and factors that the scans of a substitute share."""
        first_scan = self.selection.contact_scans(surface)[0]
        return self.path(self.patterns.conditioning, surface, scan=first_scan)

    def mirrored_scan_path(self, surface: str, scan: int) -> str:
        """Return the path of a mirrored scan."""
        return self.path(self.patterns.mirrored_scans, surface, scan=scan)

    def mirrored_scan_paths(self, surface: str) -> list[str]:
        """Return the paths of all mirrored scans of a surface."""
        scans = self.selection.contact_scans(surface)
        return [self.mirrored_scan_path(surface, scan) for scan in scans]

    @property
    def masters_sphere_path(self) -> str:
        """The path of the first scan of the sphere, the only one on masters and changed scans."""
        return self.mirrored_scan_paths(self.selection.sphere)[0]

    # Both bodies

    def contact_map_path(self, surface: str, scan: int) -> str:
        """Return the path of a mirrored scan, with the sphere's roughness if that is added."""
        if surface not in self.plan.combined_surfaces:
            return self.mirrored_scan_path(surface, scan)
        return self.path(self.patterns.combined_scans, surface, scan=scan)

    def contact_spectrum_path(self, surface: str) -> str:
        """Return the path of a spectrum, with the sphere's roughness if that is added."""
        if surface not in self.plan.combined_surfaces:
            return self.spectrum_path(surface)
        return self.path(self.patterns.combined_spectra, surface)

    def sampled_spectrum_path(self, surface: str, realization: int) -> str:
        """Return the path of a sampled spectrum, with the sphere's roughness if that is added."""
        is_combined = surface in self.plan.combined_surfaces
        patterns = self.patterns
        pattern = patterns.combined_sampled_spectra if is_combined else patterns.sampled_spectra
        return self.path(pattern, surface, realization=realization)
