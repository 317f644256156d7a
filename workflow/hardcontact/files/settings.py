"""The settings of each kind of intermediate, which its rule passes to its jobs.

Paths have the digest of these settings, so that a changed setting makes new files. Other parameters
of these rules are wildcards, or rows of the table of surfaces, whose digest paths have, too.

Most kinds have the name of their attribute of `StorePatterns`. The kinds hold:

- ``measurements``: scans of files, as read;
- ``measured_spectra``: the spectrum of a surface, from all its measurements;
- ``sampled_spectra``: such spectra, sampled within the uncertainty of the measurements;
- ``measured_scans``, ``substitute_scans``: how a scan is made; both are parts of ``scans``;
- ``scans``: levelled and mirrored scans, and the conditioning of substitutes on Table 1;
- ``both_bodies``: scans and spectra with the roughness of substrate and sphere;
- ``pull_off``: forces on a scan, with all scans of the sphere;
- ``elastic``, ``asperities``: elastic contacts of a surface, and the asperities that carry forces;
- ``perturbed_scans``: forces on a scan with each octave amplified or weakened;
- ``hindcast``: forces on a scan with random roughness in place of its outermost octaves;
- ``whole_surfaces``: forces on whole substitute surfaces, also with perturbed octaves;
- ``band_forces``: forces on the band alone, which are a result and not in the store;
- ``pool``, ``featured_candidates``: forces on scans for the sets, without and with features;
- ``masters``: scans with artificial roughness;
- purposes of `PURPOSES`: forces on filtered masters.
"""

from collections.abc import Mapping
from typing import Any

from hardcontact.config.configuration import reading_keys
from hardcontact.config.limits import random_surface_pixels
from hardcontact.config.study_plan import StudyPlan
from hardcontact.contact.numerical_limits import SHORTEST_WHOLE_RANGE
from hardcontact.files.master_purposes import PURPOSES, filtered_settings
from hardcontact.records.origin import short_digest
from hardcontact.surfaces.synthesis import SIDES

#: The kinds of the inputs of each kind; `both_bodies` are the scans if no sphere is added to them.
MADE_FROM = {
    **dict.fromkeys(("measured_scans", "measured_spectra", "sampled_spectra"), ["measurements"]),
    "scans": ["measured_scans", "substitute_scans"],
    **dict.fromkeys(("pull_off", "elastic", "asperities"), ["scans"]),
    "both_bodies": ["scans", "measured_spectra", "sampled_spectra"],
    **dict.fromkeys(("perturbed_scans", "hindcast", "masters"), ["both_bodies"]),
    **{
        name: ["masters"] if purpose.masters_are_files else ["both_bodies"]
        for name, purpose in PURPOSES.items()
    },
}


def store_settings(plan: StudyPlan) -> dict[str, dict[str, Any]]:
    """Return the settings of each kind of intermediate."""
    study = plan.configuration
    filtered_masters = {purpose: filtered_settings(study, purpose) for purpose in PURPOSES}
    return _surface_settings(plan) | _contact_settings(plan) | filtered_masters


def _surface_settings(plan: StudyPlan) -> dict[str, dict[str, Any]]:
    """Return the settings of measurements, spectra, scans and masters."""
    study = plan.configuration
    seed = {"seed": study["seed"]}
    scales = study["scales"]
    levelling = {"levelling": study["scan"]["levelling"]}
    sphere = [plan.selection.sphere, plan.selection.sphere_digest, study["sphere"]["radius"]]
    master_keys = {"short": ("pixels", "transition"), "long": ("tiles", "transition")}
    sides = {side: {key: scales[side][key] for key in keys} for side, keys in master_keys.items()}
    return {
        "measurements": reading_keys(study),
        "measured_spectra": levelling,
        "sampled_spectra": {**seed, **levelling},
        "measured_scans": levelling,
        "substitute_scans": _featured_surface(study),
        "scans": {},
        "both_bodies": {**seed, "sphere": sphere} if plan.combined_surfaces else {},
        "masters": {**seed, "sides": sides},
    }


def _contact_settings(plan: StudyPlan) -> dict[str, dict[str, Any]]:
    """Return the settings of contacts on scans, on whole surfaces, and on scans of the sets."""
    study = plan.configuration
    seed = {"seed": study["seed"]}
    scales = study["scales"]
    ranges = sorted({*study["adhesion"]["ranges"], study["adhesion"]["range"]})
    long_ranges = [rho for rho in ranges if rho >= SHORTEST_WHOLE_RANGE]
    contact = study["contact"] | {"radius": study["sphere"]["radius"]}
    contact_at_range = contact | {"rho": study["adhesion"]["range"]}
    transitions = {side: scales[side]["transition"] for side in SIDES}
    # As wide as a long-edge master, with the pixels of a scan.
    pixels, size = study["substitutes"]["pixels"], study["substitutes"]["size"]
    grid = {"pixels": 2 * scales["long"]["tiles"] * pixels, "pixel_size": size / pixels}
    whole_surface = {**_featured_surface(study), "contact": contact_at_range, "grid": grid}
    set_contact = contact | {"contacts_per_row": study["sets"]["contacts_per_row"]}
    set_scan = {**_random_surface(study), "contact": set_contact, "ranges": ranges}
    return {
        "pull_off": {
            "sphere_positions": plan.sphere_positions,
            "positions_per_row": plan.positions_per_row,
            "contact": contact_at_range | {"contacts_per_row": plan.contacts_per_row_at_position},
            "ranges": ranges,
        },
        "elastic": {**seed, "contact": contact, **study["elastic"]},
        "asperities": {**seed, "contact": contact, "asperities": study["asperities"]},
        "perturbed_scans": {"contact": contact_at_range},
        "hindcast": {**seed, "contact": contact_at_range, "transitions": transitions},
        "whole_surfaces": {**whole_surface, "ranges": long_ranges},
        "band_forces": whole_surface,
        "pool": {**set_scan, "rms_height_count": study["sets"]["rms_height_count"]},
        "featured_candidates": set_scan,
    }


def _random_surface(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the settings of random surfaces, larger than the scans that are cut from them."""
    pixels, size = study["substitutes"]["pixels"], study["substitutes"]["size"]
    scan_grid = {"pixels": pixels, "size": size, "surface_pixels": random_surface_pixels(pixels)}
    return {"seed": study["seed"], "scan_grid": scan_grid}


def _featured_surface(study: Mapping[str, Any]) -> dict[str, Any]:
    """Return the settings of random surfaces, of which one may have bumps or pits."""
    return _random_surface(study) | {"featured_surface": study["substitutes"]["featured_surface"]}


def settings_digest(settings: Mapping[str, dict[str, Any]], kind: str) -> str:
    """Return the digest of the settings of a kind and of all kinds that it is made from."""
    sources = [settings_digest(settings, source) for source in MADE_FROM.get(kind, [])]
    return short_digest([settings[kind], *sources])
