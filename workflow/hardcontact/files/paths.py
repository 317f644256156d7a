"""The paths of all files of a study: patterns with wildcards, and paths for each surface."""

import re
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath
from typing import Any

from hardcontact.base.units import path_token
from hardcontact.config.keys import SMOOTH_SPHERE
from hardcontact.config.study_plan import StudyPlan
from hardcontact.files.purposes import master_purposes
from hardcontact.files.settings import intermediate_kinds, settings_digest
from hardcontact.surfaces.features import FEATURE_KINDS
from hardcontact.surfaces.synthesis import SIDES

_SURFACE = "{surface}/{digest}"
#: The shape is what was subtracted from a scan besides a plane: nothing (flat) or the sphere.
_SCAN = f"{_SURFACE}/scan-{{scan}}-{{shape}}.nc"
_REALIZATION = f"{_SURFACE}/realization-{{realization}}"
_NUMBER = "[0-9.e+-]+"
#: The file of a measured scan, as read, in the folder of its settings.
MEASUREMENT = f"{_SURFACE}/scan-{{scan}}.nc"


class StorePatterns:
    """The paths of intermediates, with wildcards in braces where a rule makes several files.

    Paths have digests of all settings on which a file depends, and of the rows of its surface in
    the table of surfaces. So studies share files that would be equal, and keep others apart.
    Radius, loading and range stand in paths, too, so that people find a file.
    """

    def __init__(self, plan: StudyPlan) -> None:
        kinds = intermediate_kinds(plan)
        self.purposes = master_purposes(plan.study)
        self.settings = {name: kind.settings for name, kind in kinds.items()}
        self.digests = {name: settings_digest(kinds, name) for name in kinds}
        store = plan.study["store"]
        folder = {kind: f"{store}/{kind}/{digest}" for kind, digest in self.digests.items()}
        rough_sphere = f"{plan.selection.sphere_surface}/{{sphere_digest}}"

        # Scans: as read, levelled, mirrored; and how those of a batch were conditioned on Table 1,
        # in a file with the number of the first.
        scans_digest = self.digests["scans"]
        self.measurements = f"{folder['measurements']}/{MEASUREMENT}"
        self.conditioning = f"{store}/conditioning/{scans_digest}/{_SCAN}"
        self.levelled_scans = f"{store}/scans/{scans_digest}/{_SCAN}"
        self.mirrored_scans = f"{store}/mirrored/{scans_digest}/{_SCAN}"

        # Spectra: of a substitute, of all measurements, and sampled within their uncertainty.
        self.calibrated_spectra = f"{store}/spectra/{_SURFACE}/calibrated.nc"
        self.measured_spectra = f"{folder['measured_spectra']}/{_SURFACE}/measured-{{shape}}.nc"
        self.sampled_spectra = f"{folder['sampled_spectra']}/{_REALIZATION}-{{shape}}.nc"

        # Scans and spectra with the roughness of both bodies.
        self.combined_scans = f"{folder['both_bodies']}/{_SURFACE}/scan-{{scan}}.nc"
        self.combined_spectra = f"{folder['both_bodies']}/{_SURFACE}/spectrum.nc"
        self.combined_sampled_spectra = f"{folder['both_bodies']}/{_REALIZATION}.nc"

        # Contacts on all scans of a surface, and on one scan.
        surface_on_sphere = f"{{radius}}/{{loading}}/{_SURFACE}/{rough_sphere}.nc"
        self.elastic = f"{folder['elastic']}/{surface_on_sphere}"
        self.asperities = f"{folder['asperities']}/{surface_on_sphere}"
        contact_path = f"{{radius}}/{{loading}}/{{rho}}/{_SURFACE}"
        scan_on_sphere = f"{rough_sphere}/{contact_path}/scan-{{scan}}.nc"
        self.pull_off = f"{folder['pull_off']}/{scan_on_sphere}"
        self.octave_forces = f"{folder['octave_forces']}/{scan_on_sphere}"
        self.hindcast = f"{folder['hindcast']}/{scan_on_sphere}"

        # Contacts on further random surfaces, several in each file.
        self.pool = f"{folder['pool']}/{contact_path}/scans-{{first}}-{{last}}.nc"
        self.whole_surfaces = (
            f"{folder['whole_surfaces']}/{contact_path}/surfaces-{{first}}-{{last}}.nc"
        )
        self.featured_candidates = (
            f"{folder['featured_candidates']}/{contact_path}/{{features}}/{{first}}-{{last}}.nc"
        )

        # Masters, and the forces on them at lists of radii, loadings and ranges. The purpose, one
        # of `purposes`, names what the forces are for.
        self.masters = f"{folder['masters']}/{_REALIZATION}/{{side}}.nc"
        sweep = f"{{settings_digest}}/{{radii}}/{{loadings}}/{{ranges}}/{_SURFACE}"
        chunk = f"{rough_sphere}/realizations-{{first}}-{{last}}.nc"
        self.master_forces = f"{store}/filtered/{{purpose}}/{sweep}/{chunk}"


class StudyPaths:
    """The paths of the final files of a study, and of its logs and benchmarks."""

    def __init__(self, study: Mapping[str, Any]) -> None:
        self.results = f"results/{study['study']}"
        self.store = study["store"]

    def dataset(self, name: str) -> str:
        """Return the path of a final dataset."""
        return f"{self.results}/{name}.nc"

    def result(self, file: str) -> str:
        """Return the path of another final file, named with its suffix."""
        return f"{self.results}/{file}"

    def figure(self, name: str, suffix: str) -> str:
        """Return the path of a figure, whose suffix is one of FIGURE_SUFFIXES."""
        return f"{self.results}/figures/{name}.{suffix}"

    def page(self, name: str) -> str:
        """Return the path of a page of the report."""
        return f"{self.results}/report/{name}.html"

    def run_file(self, folder: str, suffix: str, rule: str, output: str) -> str:
        """Return the path of the log or benchmark of a rule, with the wildcards of its output.

        For the log of rule compute_pool, ``results/store/pool/{radius}/scans.nc`` becomes
        ``results/store/logs/compute_pool/{radius}/scans.log``.
        """
        if "{" not in output:
            return f"{self.results}/{folder}/{rule}{suffix}"
        root = self.store if output.startswith(f"{self.store}/") else self.results
        _, *folders = PurePosixPath(output).relative_to(root).with_suffix(suffix).parts
        return "/".join((root, folder, rule, *folders))


def any_name_pattern(names: Iterable[str]) -> str:
    """Return a regular expression that matches the names; without names it matches nothing."""
    return "|".join(map(re.escape, names)) or "(?!)"


def wildcard_constraints(surfaces: Iterable[str], purposes: Iterable[str]) -> dict[str, str]:
    """Return the regular expression that each wildcard must match."""
    radius = f"R{_NUMBER}um"
    loading = f"(H{_NUMBER}GPa|rigid)-F{_NUMBER}uN"
    rho = f"rho{_NUMBER}nm"
    return {
        "surface": any_name_pattern(surfaces),
        "features": "|".join(FEATURE_KINDS),
        **{number: r"\d+" for number in ("scan", "first", "last", "realization")},
        "shape": f"flat|sphere-R{_NUMBER}um",
        "side": "|".join(SIDES),
        "radius": radius,
        "loading": loading,
        "rho": rho,
        "radii": rf"{radius}(\+{radius})*",
        "loadings": rf"{loading}(\+{loading})*",
        "ranges": rf"{rho}(\+{rho})*",
        "purpose": "|".join(purposes),
        "settings_digest": "[0-9a-f]+",
        "digest": "[0-9a-f]+",
        "sphere_digest": f"[0-9a-f]+|{SMOOTH_SPHERE}",
    }


class SurfaceFiles:
    """The paths of the files of each surface of one study."""

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
        is_sphere = surface == self.selection.sphere_surface
        surface_values = {
            "shape": f"sphere-{self._defaults['radius']}" if is_sphere else "flat",
            "digest": self.selection.digests[surface],
        }
        return pattern.format(surface=surface, **self._defaults | surface_values | wildcards)

    def paths(self, pattern: str, rows: Iterable[Any]) -> list[str]:
        """Return the paths of a pattern, one for each row, whose fields are its wildcards."""
        return [self.path(pattern, **row._asdict()) for row in rows]

    def spectrum_path(self, surface: str) -> str:
        """Return the path of a spectrum: as measured, or for a substitute as calibrated."""
        if surface in self.selection.measured_surfaces:
            return self.path(self.patterns.measured_spectra, surface)
        return self.path(self.patterns.calibrated_spectra, surface)

    def measurement_paths(self, surface: str) -> list[str]:
        """Return the paths of all scans of a measured surface; none for a substitute."""
        if surface not in self.selection.measured_surfaces:
            return []
        numbers = self.selection.all_scan_numbers(surface)
        return [self.path(self.patterns.measurements, surface, scan=number) for number in numbers]

    def mirrored_scan_path(self, surface: str, scan: int) -> str:
        """Return the path of a mirrored scan."""
        return self.path(self.patterns.mirrored_scans, surface, scan=scan)

    def mirrored_scan_paths(self, surface: str) -> list[str]:
        """Return the paths of all mirrored scans of a surface."""
        numbers = self.selection.contact_scan_numbers(surface)
        return [self.mirrored_scan_path(surface, number) for number in numbers]

    @property
    def first_sphere_scan_path(self) -> str:
        """The path of the sphere's first scan, mirrored, for masters and octaves."""
        return self.mirrored_scan_paths(self.selection.sphere_surface)[0]

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
