"""The files of the surfaces of one study: their spectra, their scans, and both bodies together."""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from math import ceil, sqrt
from typing import Any, NamedTuple

from hardcontact.base.units import path_token
from hardcontact.config.configuration import combines_bodies, study_contact
from hardcontact.config.model import POSITION_CONTACTS_PER_ROW, SMOOTH_SPHERE, SPHERE_POSITIONS
from hardcontact.config.selected_surfaces import Selection
from hardcontact.files.patterns import Patterns


class Scan(NamedTuple):
    """A row of lists; its fields are wildcards of patterns."""

    surface: str
    scan: int


class SurfaceFiles:
    """The files of the surfaces of one study: spectra, scans, and the maps that are touched."""

    def __init__(
        self, configuration: Mapping[str, Any], selection: Selection, patterns: Patterns
    ) -> None:
        self.configuration = configuration
        self.selection = selection
        self.patterns = patterns
        self.contact = study_contact(configuration)
        self.sphere_digest = selection.file_digests.get(selection.sphere, SMOOTH_SPHERE)
        self._defaults = {
            "radius": f"R{path_token(configuration['sphere']['radius'], 'um')}",
            "loading": self.contact.loading_name,
            "range": f"rho{path_token(configuration['adhesion']['range'], 'nm')}",
            "sphere_digest": self.sphere_digest,
        }
        self._combines_bodies = combines_bodies(configuration)

    def path(self, pattern: str, surface: str, **wildcards: object) -> str:
        """Return the path of a pattern for a surface; wildcards default to values of the study."""
        is_sphere = surface == self.selection.sphere
        surface_values = {
            "shape": f"sphere-{self._defaults['radius']}" if is_sphere else "flat",
            "digest": self.selection.file_digests[surface],
        }
        return pattern.format(surface=surface, **self._defaults | surface_values | wildcards)

    def paths(self, pattern: str, rows: Iterable[Any]) -> list[str]:
        """Return the paths of a pattern, one for each row."""
        return [self.path(pattern, **row._asdict()) for row in rows]

    # Surfaces

    def spectrum_path(self, surface: str) -> str:
        """Return the path of the spectrum of a surface at all scales."""
        is_measured = self.selection.source[surface] == "measured"
        patterns = self.patterns
        pattern = patterns.measured_spectrum if is_measured else patterns.calibrated_spectrum
        return self.path(pattern, surface)

    def measurement_paths(self, surface: str) -> list[str]:
        """Return the paths of all scans of a measured surface; none for a substitute."""
        if self.selection.source[surface] != "measured":
            return []
        scans = self.selection.all_scans(surface)
        return [self.path(self.patterns.measurement, surface, scan=scan) for scan in scans]

    def levelling_settings(self, surface: str) -> dict[str, Any]:
        """Return the levelling of the scans of a surface, with the radius (nm) of a sphere."""
        radius = self.configuration["sphere"]["radius"]
        return {
            "levelling": self.configuration["scan"]["levelling"],
            "sphere_radius": radius if surface == self.selection.sphere else None,
        }

    def measurement_settings(self, surface: str) -> dict[str, Any]:
        """Return the levelling and the tip radii (nm) of the measurements of a surface."""
        return {"tip_radii": self.selection.tip_radii(surface), **self.levelling_settings(surface)}

    @property
    def conditioning_paths(self) -> dict[str, str]:
        """The gain and factors that the study's scans of each substitute share, by surface."""
        scans = self.selection.scans
        return {
            surface: self.path(self.patterns.conditioning, surface, scan=scans(surface)[0])
            for surface, source in self.selection.source.items()
            if source == "substitute"
        }

    @property
    def scan_groups(self) -> dict[tuple[int, ...], list[str]]:
        """Groups of scans that are made together, by numbers, each with its substitutes."""
        realizations = max(self.configuration[key]["realizations"] for key in ("sets", "exponents"))
        selection = self.selection
        groups = defaultdict[tuple[int, ...], list[str]](list)
        for surface in self.conditioning_paths:
            last_group = selection.group(surface, selection.separate_scan(surface, realizations))
            for group in range(last_group + 1):
                groups[tuple(selection.scans_of_group(surface, group))].append(surface)
        return groups

    def stitched_path(self, surface: str, scan: int) -> str:
        """Return the path of a levelled scan with its mirror images."""
        return self.path(self.patterns.stitched, surface, scan=scan)

    def realization_scan_path(self, surface: str, realization: int) -> str:
        """Return the path of the scan of a realization; realizations use the scans in turn."""
        scans = self.selection.scans(surface)
        return self.roughness_path(surface, scans[(realization - 1) % len(scans)])

    def separate_scan_path(self, surface: str, realization: int) -> str:
        """Return the path of a scan of one realization only; measured scans come in turn."""
        if self.selection.source[surface] == "measured":
            return self.realization_scan_path(surface, realization)
        return self.roughness_path(surface, self.selection.separate_scan(surface, realization))

    def master_path(self, surface: str, realization: int, side: str) -> str:
        """Return the path of the master of a realization on one side."""
        return self.path(self.patterns.master, surface, realization=realization, side=side)

    @property
    def first_sphere_path(self) -> str:
        """The path of the scan that roughens the sphere on all masters."""
        sphere = self.selection.sphere
        return self.stitched_path(sphere, self.selection.scans(sphere)[0])

    # Both bodies

    @property
    def combined_surfaces(self) -> list[str]:
        """The measured substrates to which the roughness of a measured sphere is added."""
        source = self.selection.source
        if not self._combines_bodies or source[self.selection.sphere] != "measured":
            return []
        return [name for name in self.selection.substrates if source[name] == "measured"]

    def rough_bodies(self, surface: str, scan: int) -> list[Scan]:
        """Return a substrate's scan, and the sphere's scan if its roughness is added."""
        bodies = [Scan(surface, scan)]
        if surface in self.combined_surfaces:
            bodies.append(Scan(self.selection.sphere, self.sphere_scan(surface, scan)))
        return bodies

    def roughness_path(self, surface: str, scan: int) -> str:
        """Return the path of a stitched scan, with the sphere's roughness if that is added."""
        if surface not in self.combined_surfaces:
            return self.stitched_path(surface, scan)
        return self.path(self.patterns.combined_scan, surface, scan=scan)

    def roughness_spectrum_path(self, surface: str) -> str:
        """Return the path of a spectrum, with the sphere's roughness if that is added."""
        if surface not in self.combined_surfaces:
            return self.spectrum_path(surface)
        return self.path(self.patterns.combined_spectrum, surface)

    def sampled_spectrum_path(self, surface: str, realization: int) -> str:
        """Return the path of a sampled spectrum, with the sphere's roughness if that is added."""
        is_combined = surface in self.combined_surfaces
        patterns = self.patterns
        pattern = patterns.combined_sampled_spectrum if is_combined else patterns.sampled_spectrum
        return self.path(pattern, surface, realization=realization)

    def sphere_scan(self, surface: str, scan: int) -> int:
        """Return the scan of the sphere that meets a scan of a substrate, in turn."""
        sphere_scans = self.selection.sphere_scans
        return sphere_scans[self.selection.scans(surface).index(scan) % len(sphere_scans)]

    def measurements_of_map(self, surface: str, scan: int) -> list[int]:
        """Return the indices of the measurements, in a spectrum, whose roughness a map has."""
        scans = self.selection.all_scans(surface)
        indices = [scans.index(scan)]
        if surface in self.combined_surfaces:
            sphere_scans = self.selection.all_scans(self.selection.sphere)
            indices.append(len(scans) + sphere_scans.index(self.sphere_scan(surface, scan)))
        return indices

    @property
    def positions_per_row(self) -> int:
        """Positions per row on each scan of the sphere at which it touches the user's surfaces."""
        if not self._combines_bodies:
            return 1
        return ceil(sqrt(SPHERE_POSITIONS / len(self.selection.sphere_scans)))

    @property
    def sphere_positions(self) -> list[int]:
        """The numbers of positions on the sphere: numbers of its scans if each has one position."""
        if self.positions_per_row == 1:
            return self.selection.sphere_scans
        count = len(self.selection.sphere_scans) * self.positions_per_row**2
        return list(range(1, count + 1))

    @property
    def position_contacts_per_row(self) -> int:
        """Contacts per row of their array at each position on the sphere."""
        count = int(self.configuration["contact"]["contacts_per_row"])
        return count if self.positions_per_row == 1 else min(count, POSITION_CONTACTS_PER_ROW)

    # Scans

    @property
    def scans(self) -> list[Scan]:
        """Every scan."""
        return self._scans_of(self.selection.surfaces)

    @property
    def substrate_scans(self) -> list[Scan]:
        """Every scan of a substrate."""
        return self._scans_of(self.selection.substrates)

    def _scans_of(self, surfaces: Iterable[str]) -> list[Scan]:
        """Return every scan of surfaces."""
        scans = self.selection.scans
        return [Scan(surface, scan) for surface in surfaces for scan in scans(surface)]

    @property
    def substitutes(self) -> list[str]:
        """The substitute substrates."""
        source = self.selection.source
        return [name for name in self.selection.substrates if source[name] == "substitute"]

    @property
    def measured_scans(self) -> list[Scan]:
        """Every scan of a measured substrate."""
        return [scan for scan in self.substrate_scans if scan.surface not in self.substitutes]

    @property
    def featured_surfaces(self) -> list[str]:
        """The substrate whose scans have features, if it is a substitute of a published surface."""
        surface = self.configuration["scan"]["featured_surface"]
        return [name for name in self.selection.sampled_substrates if name == surface]

    @property
    def whole_surface_grid(self) -> dict[str, Any]:
        """Pixels per row of a whole surface, and their size (nm), as of long masters."""
        scan = self.configuration["scan"]
        tiles = self.configuration["scales"]["long"]["tiles"]
        return {"pixels": 2 * tiles * scan["pixels"], "pixel_size": scan["size"] / scan["pixels"]}
