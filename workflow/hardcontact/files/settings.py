"""The settings of each kind of intermediate: all that its rule takes from the configuration.

The path of a file has a digest of these settings, and of the settings of the kinds that the file is
made from. So a changed setting makes new files.

The settings of forces on masters are those of their purpose (`files/purposes.py`).
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from hardcontact.config.configuration import (
    contact_arguments,
    is_paper_study,
    reading_arguments,
)
from hardcontact.config.limits import MAX_MAP_PIXELS
from hardcontact.config.study_plan import StudyPlan
from hardcontact.contact.numerical_limits import SHORTEST_WHOLE_RANGE
from hardcontact.files.purposes import Purpose, master_purposes
from hardcontact.records.origin import short_value_digest
from hardcontact.surfaces.synthesis import SIDES

#: Width of the periodic random surface from which a substitute is cut, in widths of the substitute.
#: A real scan has waves longer than itself and does not continue at its borders; a larger surface
#: would imitate this better, but takes more memory.
RANDOM_SURFACE_WIDTH_RATIO = 4
#: Bytes per pixel of a master, rounded: 13.2, the maximum measured at 8192 x 8192 pixels, and 4 of
#: another map, which writing the file may need.
BYTES_PER_PIXEL = 17.0
#: Megabytes of Python, its packages, the scan, and blocks of rows in double precision.
BASE_MEGABYTES = 500
#: Least memory (MB) that a job on masters reserves; on a cluster Snakemake runs in it, too.
MINIMUM_MEGABYTES = 3000


class IntermediateKind(NamedTuple):
    """A kind of intermediate: its settings, and the names of the kinds that it is made from."""

    settings: dict[str, Any]
    made_from: Sequence[str] = ()


def intermediate_kinds(plan: StudyPlan) -> dict[str, IntermediateKind]:
    """Return the kinds of intermediates by name.

    Each is made from the kinds above it that are indented less; the last row needs none:

        measurements
            measured_spectra, sampled_spectra
            measured_scans
        substitute_scans
            scans (of both rows before)
                pull_off, elastic, asperities
                both_bodies (also of both kinds of spectra)
                    octave_forces, hindcast, forces on masters that are no files
                    masters
                        forces on these masters: edges
        whole_surfaces, band_forces, pool, featured_candidates
    """
    master_forces = {
        name: IntermediateKind(
            _master_force_settings(plan.study, purpose),
            ["masters" if purpose.masters_are_files else "both_bodies"],
        )
        for name, purpose in master_purposes(plan.study).items()
    }
    contacts = _scan_contact_kinds(plan) | _random_surface_kinds(plan.study)
    return _surface_kinds(plan) | contacts | master_forces


def _surface_kinds(plan: StudyPlan) -> dict[str, IntermediateKind]:
    """Return the kinds of measurements, spectra, scans and masters."""
    study = plan.study
    seed = {"seed": study["seed"]}
    levelling = {"levelling": study["scan"]["levelling"]}
    selection = plan.selection
    sphere = [selection.sphere_surface, selection.sphere_digest, study["sphere"]["radius"]]
    # A long-edge master has the pixels of its scan; its key `pixels` is for the forces on it.
    side_keys = {"short": ("pixels", "transition"), "long": ("tiles", "transition")}
    band = study["band"]
    sides = {side: {key: band[side][key] for key in keys} for side, keys in side_keys.items()}
    return {
        # Measured scans, as their files have them, and their spectra.
        "measurements": IntermediateKind(reading_arguments(study)),
        "measured_spectra": IntermediateKind(levelling, ["measurements"]),
        # Spectra sampled within the uncertainty of the measurements.
        "sampled_spectra": IntermediateKind({**seed, **levelling}, ["measurements"]),
        # Levelled and mirrored scans, measured or substitutes. With substitutes comes their
        # conditioning: how they meet Table 1. All have paths with the digest of `scans`.
        "measured_scans": IntermediateKind(levelling, ["measurements"]),
        "substitute_scans": IntermediateKind(_substitute_settings(study)),
        "scans": IntermediateKind({}, ["measured_scans", "substitute_scans"]),
        # Scans and spectra with the roughness of both bodies; unchanged if none is added.
        "both_bodies": IntermediateKind(
            {**seed, "sphere": sphere} if plan.combined_surfaces else {},
            ["scans", "measured_spectra", "sampled_spectra"],
        ),
        "masters": IntermediateKind({**seed, "sides": sides}, ["both_bodies"]),
    }


def _scan_contact_kinds(plan: StudyPlan) -> dict[str, IntermediateKind]:
    """Return the kinds of contacts on scans."""
    study = plan.study
    seed = {"seed": study["seed"]}
    contact = contact_arguments(study)
    contact_at_range = contact | {"rho": study["adhesion"]["range"]}
    pull_off = {
        "sphere_positions": plan.sphere_positions,
        "positions_per_row": plan.positions_per_row,
        "contact": contact_at_range | {"contacts_per_row": plan.contacts_per_row_at_position},
        "ranges": _all_ranges(study),
    }
    asperities = {**seed, "contact": contact, "asperities": study["asperities"]}
    transitions = {side: study["band"][side]["transition"] for side in SIDES}
    hindcast = {**seed, "contact": contact_at_range, "transitions": transitions}
    return {
        # Forces on a scan, with all scans of the sphere.
        "pull_off": IntermediateKind(pull_off, ["scans"]),
        "elastic": IntermediateKind({**seed, "contact": contact, **study["elastic"]}, ["scans"]),
        "asperities": IntermediateKind(asperities, ["scans"]),
        # Forces on a scan with each octave changed.
        "octave_forces": IntermediateKind({"contact": contact_at_range}, ["both_bodies"]),
        # Forces on a scan with random roughness in place of its outermost octaves.
        "hindcast": IntermediateKind(hindcast, ["both_bodies"]),
    }


def _random_surface_kinds(study: Mapping[str, Any]) -> dict[str, IntermediateKind]:
    """Return the kinds of contacts on whole random surfaces and on scans of the sets."""
    ranges = _all_ranges(study)
    # The posterior needs all ranges that whole surfaces permit, and only the paper's study has it.
    permitted_ranges = [rho for rho in ranges if rho >= SHORTEST_WHOLE_RANGE]
    whole_ranges = permitted_ranges if is_paper_study(study) else [study["adhesion"]["range"]]
    contact = contact_arguments(study)
    # As wide as a long-edge master, with the pixels of a scan.
    pixels, size = study["substitutes"]["pixels"], study["substitutes"]["size"]
    grid = {"pixels": 2 * study["band"]["long"]["tiles"] * pixels, "pixel_size": size / pixels}
    whole_surface = {
        **_substitute_settings(study),
        "contact": contact | {"rho": study["adhesion"]["range"]},
        "grid": grid,
    }
    set_contact = contact | {"contacts_per_row": study["sets"]["contacts_per_row"]}
    set_scan = {**_grid_settings(study), "contact": set_contact, "ranges": ranges}
    rms_heights = {"rms_height_count": study["sets"]["rms_height_count"]}
    return {
        # Forces on whole substitute surfaces, also with each octave changed.
        "whole_surfaces": IntermediateKind({**whole_surface, "ranges": whole_ranges}),
        # Forces on the band alone. These files are not in the store, because they depend on the
        # edges that the study found.
        "band_forces": IntermediateKind(whole_surface),
        # Scans among which sets choose, and forces on them: without features, then with. The
        # masters of the sets are no part of the pool: `sets` is a purpose of forces on masters.
        "pool": IntermediateKind(set_scan | rms_heights),
        "featured_candidates": IntermediateKind(set_scan),
    }


def _all_ranges(study: Mapping[str, Any]) -> list[float]:
    """Return the ranges of adhesion at which forces are computed."""
    return sorted({*study["adhesion"]["ranges"], study["adhesion"]["range"]})


def _grid_settings(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the seed and the grid of substitute scans."""
    pixels, size = study["substitutes"]["pixels"], study["substitutes"]["size"]
    surface_pixels = min(RANDOM_SURFACE_WIDTH_RATIO * pixels, MAX_MAP_PIXELS)
    scan_grid = {"pixels": pixels, "size": size, "surface_pixels": surface_pixels}
    return {"seed": study["seed"], "scan_grid": scan_grid}


def _substitute_settings(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the settings of substitutes."""
    return _grid_settings(study) | {"featured_surface": study["substitutes"]["featured_surface"]}


def settings_digest(kinds: Mapping[str, IntermediateKind], name: str) -> str:
    """Return the digest of the settings of a kind and of all kinds that it is made from."""
    kind = kinds[name]
    sources = [settings_digest(kinds, source) for source in kind.made_from]
    return short_value_digest([kind.settings, *sources])


def _master_force_settings(study: Mapping[str, Any], purpose: Purpose) -> dict[str, Any]:
    """Return the settings of the forces on the masters of a purpose; lengths are in nm."""
    names = ("stream", "contacts_per_row", "sides", "radii", "loadings", "ranges")
    settings = {name: getattr(purpose, name) for name in names}
    return {"seed": study["seed"], "window": study["contact"]["window"], **settings}


def largest_master_megabytes(settings: Mapping[str, Any]) -> int:
    """Return the memory (MB) of a job on the masters of a purpose, from the side with most pixels.

    `settings` are those of `_master_force_settings`.
    """
    pixels: int = max(side["pixels"] for side in settings["sides"].values())
    return max(MINIMUM_MEGABYTES, BASE_MEGABYTES + math.ceil(BYTES_PER_PIXEL * pixels**2 / 1e6))
