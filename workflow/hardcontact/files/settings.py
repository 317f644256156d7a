"""The settings of each kind of intermediate, which its rule passes to its jobs.

Rules of intermediates take settings from here alone, and paths have the digest of all of them. The
other parameters of these rules are wildcards, or come from the rows of a surface in the table of
surfaces, whose digest paths have, too.
"""

from collections.abc import Mapping
from typing import Any

from hardcontact.config.configuration import reading_keys
from hardcontact.config.limits import random_surface_pixels
from hardcontact.config.study_plan import StudyPlan
from hardcontact.contact.contact import SHORTEST_WHOLE_RANGE
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
    """Return the settings of each kind of intermediate; `band` alone is a kind of result."""
    study = plan.configuration
    seed = {"seed": study["seed"]}
    levelling = {"levelling": study["scan"]["levelling"]}
    substitutes, scales, sets = (study[name] for name in ("substitutes", "scales", "sets"))
    pixels, size = substitutes["pixels"], substitutes["size"]
    # Scans are cut from a larger random surface.
    scan_grid = {"pixels": pixels, "size": size, "surface_pixels": random_surface_pixels(pixels)}
    random_surface = seed | {"scan_grid": scan_grid}
    featured_surface = random_surface | {"featured_surface": substitutes["featured_surface"]}
    contact = study["contact"] | {"radius": study["sphere"]["radius"]}
    contact_at_range = {"contact": contact | {"rho": study["adhesion"]["range"]}}
    # As wide as a long-edge master, with the pixels of a scan.
    grid = {"pixels": 2 * scales["long"]["tiles"] * pixels, "pixel_size": size / pixels}
    whole_surface = featured_surface | contact_at_range | {"grid": grid}
    ranges = sorted({*study["adhesion"]["ranges"], study["adhesion"]["range"]})
    set_contact = contact | {"contacts_per_row": sets["contacts_per_row"]}
    set_forces = random_surface | {"contact": set_contact, "ranges": ranges}
    positions, positions_per_row, contacts_per_row = plan.sphere_positions()
    position_contact = contact_at_range["contact"] | {"contacts_per_row": contacts_per_row}
    sphere = [plan.selection.sphere, plan.selection.sphere_digest, contact["radius"]]
    transitions = {side: scales[side]["transition"] for side in SIDES}
    sides = {
        side: {key: scales[side][key] for key in (grid_key, "transition")}
        for side, grid_key in (("short", "pixels"), ("long", "tiles"))
    }
    return {
        "measurements": reading_keys(study),
        "measured_spectra": levelling,
        "sampled_spectra": levelling | seed,
        "measured_scans": levelling,
        "substitute_scans": featured_surface,
        "scans": {},
        "both_bodies": seed | {"sphere": sphere} if plan.combined_surfaces else {},
        "pull_off": {
            "sphere_positions": positions,
            "positions_per_row": positions_per_row,
            "contact": position_contact,
            "ranges": ranges,
        },
        "elastic": seed | {"contact": contact} | study["elastic"],
        "asperities": seed | {"contact": contact, "asperities": study["asperities"]},
        "perturbed_scans": contact_at_range,
        "hindcast": seed | contact_at_range | {"transitions": transitions},
        "whole": whole_surface | {"ranges": [r for r in ranges if r >= SHORTEST_WHOLE_RANGE]},
        "band": whole_surface,
        "pool": set_forces | {"rms_height_count": sets["rms_height_count"]},
        "featured_samples": set_forces,
        "masters": seed | {"sides": sides},
        **{purpose: filtered_settings(study, purpose) for purpose in PURPOSES},
    }


def settings_digest(settings: Mapping[str, dict[str, Any]], kind: str) -> str:
    """Return the digest of the settings of a kind and of all kinds that it is made from."""
    sources = [settings_digest(settings, source) for source in MADE_FROM.get(kind, [])]
    return short_digest([settings[kind], *sources])
