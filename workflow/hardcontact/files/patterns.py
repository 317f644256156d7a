"""The paths of all files of a study: patterns with wildcards, and what wildcards may match."""

import re
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath
from typing import Any

from hardcontact.config.configuration import combines_bodies, get_key
from hardcontact.config.keys import SMOOTH_SPHERE
from hardcontact.files.master_purposes import PURPOSES
from hardcontact.records.origin import short_digest
from hardcontact.surfaces.features import KINDS

_KEYS_OF_READING = ("scan.undefined_pixels", "scan.unit", "scan.map_size", "scan.mask")
_KEYS_OF_MEASURED = (*_KEYS_OF_READING, "scan.levelling", "scans")
_KEYS_OF_GAUSSIAN = ("seed", "scans", "substitutes.pixels", "substitutes.size")
_KEYS_OF_SUBSTITUTES = (*_KEYS_OF_GAUSSIAN, "substitutes.featured_surface")
#: Keys on which every scan, measured or substitute, and everything computed from scans depend.
KEYS_OF_SCANS = (*_KEYS_OF_SUBSTITUTES, *_KEYS_OF_MEASURED)
_KEYS_OF_CONTACTS = (*KEYS_OF_SCANS, "contact.window", "contact.contacts_per_row")
_KEYS_OF_SETS = (*_KEYS_OF_GAUSSIAN, "sets.contacts_per_row", "contact.window", "adhesion.ranges")
_TRANSITION_KEYS = ("scales.short.transition", "scales.long.transition")

#: For each kind of intermediate, the keys whose digest its path has: those that its rule and the
#: rules of its inputs read. Not needed are keys whose value is in the path, and the files of a
#: surface, which `{digest}` covers. The list is written by hand, because rules need paths before
#: they read keys; tests/workflow/test_two_studies.py finds missing keys, but not those of files of
#: measured surfaces.
STORE_KEYS = {
    "measurements": _KEYS_OF_READING,
    "measured_spectra": _KEYS_OF_MEASURED,
    "sampled_spectra": (*_KEYS_OF_MEASURED, "seed"),
    "conditioning": KEYS_OF_SCANS,  # which is made with the scans
    "scans": KEYS_OF_SCANS,
    "stitched": KEYS_OF_SCANS,
    "pull_off": (*_KEYS_OF_CONTACTS, "adhesion.ranges"),
    "elastic": (*_KEYS_OF_CONTACTS, "elastic.contacts"),
    "asperities": (*_KEYS_OF_CONTACTS, "asperities"),
    "whole": (*_KEYS_OF_CONTACTS, "adhesion.ranges", "scales.long.tiles"),
    "perturbed_scans": _KEYS_OF_CONTACTS,
    "hindcast": (*_KEYS_OF_CONTACTS, *_TRANSITION_KEYS),
    "pool": (*_KEYS_OF_SETS, "sets.rms_height_count"),
    "featured_samples": _KEYS_OF_SETS,
    "both_bodies": KEYS_OF_SCANS,
    "masters": (*KEYS_OF_SCANS, *_TRANSITION_KEYS, "scales.short.pixels", "scales.long.tiles"),
}

#: Intermediates that may have the roughness of both bodies, and the keys on which they then depend.
BOTH_BODIES_KEYS = ("published", "sphere.surface", "sphere.radius", "seed")
KINDS_WITH_BOTH_BODIES = frozenset(
    {"both_bodies", "perturbed_scans", "hindcast", "masters", "pull_off"}
)

_SURFACE = "{surface}/{digest}"
_SCAN = f"{_SURFACE}/scan-{{scan}}-{{shape}}.nc"
_REALIZATION = f"{_SURFACE}/realization-{{realization}}"
_NUMBER = "[0-9.e+-]+"


def values_of_keys(configuration: Mapping[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    """Return the values of keys, with dots between their parts."""
    return {key: get_key(configuration, key) for key in keys}


def store_digests(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the digest of the keys of each kind of intermediate."""
    further = BOTH_BODIES_KEYS if combines_bodies(configuration) else ()
    return {
        kind: short_digest(
            values_of_keys(
                configuration, (*keys, *further) if kind in KINDS_WITH_BOTH_BODIES else keys
            )
        )
        for kind, keys in STORE_KEYS.items()
    }


class Patterns:
    """The paths of a study, with wildcards in braces where a rule makes several files.

    Paths of intermediates contain the values of the quantities that people sweep, and a digest of
    all other keys on which they depend. Files for several values of a key can therefore coexist.
    """

    def __init__(self, results: str, store: str, sphere: str, digests: Mapping[str, str]) -> None:
        self.results = results
        self.store = store
        folder = {kind: f"{store}/{kind}/{digest}" for kind, digest in digests.items()}

        rough_sphere = f"{sphere}/{{sphere_digest}}"

        self.calibrated_spectrum = f"{store}/spectra/{_SURFACE}/calibrated.nc"
        self.measured_spectrum = f"{folder['measured_spectra']}/{_SURFACE}/measured-{{shape}}.nc"
        self.conditioning = f"{folder['conditioning']}/{_SCAN}"  # scan: the first of its group
        self.measurement = f"{folder['measurements']}/{_SURFACE}/scan-{{scan}}.nc"
        self.levelled = f"{folder['scans']}/{_SCAN}"
        self.stitched = f"{folder['stitched']}/{_SCAN}"
        self.stitched_substrate = self.stitched.replace("{shape}", "flat")

        both_surfaces = f"{{radius}}/{{loading}}/{_SURFACE}/{rough_sphere}.nc"
        self.elastic_contacts = f"{folder['elastic']}/{both_surfaces}"
        self.asperities = f"{folder['asperities']}/{both_surfaces}"

        contact = f"{{radius}}/{{loading}}/{{rho}}/{_SURFACE}"
        self.pool_forces = f"{folder['pool']}/{contact}/scans-{{first}}-{{last}}.nc"
        self.whole_surface_forces = f"{folder['whole']}/{contact}/surfaces-{{first}}-{{last}}.nc"
        scan_on_sphere = f"{rough_sphere}/{contact}/scan-{{scan}}.nc"
        self.pull_off = f"{folder['pull_off']}/{scan_on_sphere}"
        self.perturbed_scan_forces = f"{folder['perturbed_scans']}/{scan_on_sphere}"
        self.hindcast_forces = f"{folder['hindcast']}/{scan_on_sphere}"
        # Not in the store: these forces are of the band that the study itself found.
        self.band_forces = f"{results}/band/{{surface}}.nc"
        self.featured_sample_forces = (
            f"{folder['featured_samples']}/{contact}/{{features}}/samples-{{first}}-{{last}}.nc"
        )
        self.master = f"{folder['masters']}/{_REALIZATION}/{{side}}.nc"
        # A spectrum sampled within the uncertainty of the measurements.
        self.sampled_spectrum = f"{folder['sampled_spectra']}/{_REALIZATION}.nc"
        # Forces at lists of radii, loadings and ranges; settings_digest: `Chunks._settings_digest`.
        sweep = f"{{settings_digest}}/{{radii}}/{{loadings}}/{{ranges}}/{_SURFACE}"
        realizations = "realizations-{first}-{last}-{sphere_kind}-sphere"
        # The roughness of both bodies.
        both = f"{folder['both_bodies']}/{rough_sphere}"
        self.combined_scan = f"{both}/{_SURFACE}/scan-{{scan}}.nc"
        self.combined_spectrum = f"{both}/{_SURFACE}/spectrum.nc"
        self.combined_sampled_spectrum = f"{both}/{_REALIZATION}.nc"
        self.filtered_master_forces = f"{store}/filtered/{{purpose}}/{sweep}/{realizations}.nc"

    def dataset(self, name: str) -> str:
        """Return the path of a final dataset."""
        return f"{self.results}/{name}.nc"

    def result(self, file: str) -> str:
        """Return the path of another final file, named with its suffix."""
        return f"{self.results}/{file}"

    def figure(self, name: str, kind: str) -> str:
        """Return the path of a figure, by its kind: pdf, png, svg or csv."""
        return f"{self.results}/figures/{name}.{kind}"

    def page(self, name: str) -> str:
        """Return the path of a page of the report."""
        return f"{self.results}/report/{name}.html"

    def run_file(self, kind: str, suffix: str, rule: str, output: str) -> str:
        """Return the path of the log or benchmark of a rule, with the wildcards of its output."""
        if "{" not in output:
            return f"{self.results}/{kind}/{rule}{suffix}"
        root = self.store if output.startswith(f"{self.store}/") else self.results
        _, *folders = PurePosixPath(output).relative_to(root).with_suffix(suffix).parts
        return "/".join((root, kind, rule, *folders))


def study_patterns(configuration: Mapping[str, Any]) -> Patterns:
    """Return the paths of a study."""
    return Patterns(
        f"results/{configuration['study']}",
        configuration["store"],
        configuration["sphere"]["surface"],
        store_digests(configuration),
    )


def any_name_pattern(names: Iterable[str]) -> str:
    """Return a regular expression that matches the names; without names it matches nothing."""
    return "|".join(map(re.escape, names)) or "(?!)"


def list_pattern(expression: str) -> str:
    """Return a regular expression of a list with plus signs between its values."""
    return rf"{expression}(\+{expression})*"


def wildcard_constraints(surfaces: Iterable[str]) -> dict[str, str]:
    """Return the regular expression that each wildcard must match."""
    radius = f"R{_NUMBER}um"
    loading = f"(H{_NUMBER}GPa|rigid)-F{_NUMBER}uN"
    rho = f"rho{_NUMBER}nm"
    return {
        "surface": any_name_pattern(surfaces),
        "features": "|".join(KINDS),
        **dict.fromkeys(("scan", "first", "last", "realization"), r"\d+"),
        "shape": f"flat|sphere-R{_NUMBER}um",
        "side": "short|long",
        "sphere_kind": "smooth|rough|combined",
        "radius": radius,
        "loading": loading,
        "rho": rho,
        "radii": list_pattern(radius),
        "loadings": list_pattern(loading),
        "ranges": list_pattern(rho),
        "purpose": "|".join(PURPOSES),
        "settings_digest": "[0-9a-f]+",
        "digest": "[0-9a-f]+",
        "sphere_digest": f"[0-9a-f]+|{SMOOTH_SPHERE}",
    }
