"""What each part of the chapter means for the critical band: one sentence of plain text each.

Every function takes what the sentences of its part take: see `insight_parts.PARTS`.
"""

import numpy as np
import xarray as xr

from hardcontact.answer.contact_sentences import amounts, disputed
from hardcontact.answer.part_text import EDGE_NAMES, differs_from_one, labels, listed
from hardcontact.answer.scan_size_sentences import on_scans
from hardcontact.insight.edge_scaling import INDEPENDENT, PARTS, UNDECIDED
from hardcontact.insight.interaction_laws import EXPONENTIAL
from hardcontact.numbers.printing import DIGITS, print_as_paper, print_percent
from hardcontact.numbers.statistics import bounds
from hardcontact.scales.critical_band import POOLED
from hardcontact.surfaces.synthesis import SIDES


def clause_of_scaling(scaling: xr.Dataset) -> str:
    """Return on how many surfaces each edge changes with sphere, range and contact."""
    of_all = scaling["dependence"].sel(part=PARTS[0])
    changes = (~of_all.isin([INDEPENDENT, UNDECIDED])).sum("surface")
    number = scaling.sizes["surface"]
    short, long = (
        listed(str(count) for count in changes.sel(side=side).values.tolist()) for side in SIDES
    )
    if changes.any():
        follows = "the band does not belong to the surface alone"
    elif (of_all == UNDECIDED).any():
        follows = "whether the band belongs to the surface alone is not decided"
    else:
        follows = "nothing speaks against a band of the surface alone"
    return (
        f"The short edge is seen to change with √R, √ρ and √(F/H) on {short} of {number} surfaces, "
        f"the long edge on {long}: {follows}."
    )


def clause_of_scan_size(scan_size: xr.Dataset) -> str:
    """Return where long edges of small scans differ from those of whole surfaces."""
    of_scan = on_scans(scan_size)
    low, high = bounds(of_scan, "long_edge")
    whole_low, whole_high = bounds(scan_size.isel(edge_size=-1), "long_edge")
    where = _where(scan_size, (low > whole_high) | (high < whole_low))
    spans = (high / low).values
    widest = spans[np.isfinite(spans)]
    so = (
        f"where its interval is closed this spans factors of up to {widest.max():.{DIGITS}g}"
        if widest.size
        else "no such interval is closed"
    )
    return (
        f"The long edge from mirrored scans of {print_as_paper(of_scan['edge_size'].item(), 'nm')} "
        f"differs beyond its interval from that of whole surfaces on {where}, but {so}."
    )


def clause_of_closed_form(closed_form: xr.Dataset, band: xr.Dataset) -> str:
    """Return which predicted edges lie within the intervals of the computed ones."""
    computed = band.sel(group=closed_form["surface"].values)
    low, high = (end.rename(group="surface") for end in bounds(computed, "critical_wavelength"))
    within = (closed_form["edge"] >= low) & (closed_form["edge"] <= high)
    short, long = (_where(closed_form, within.sel(side=side)) for side in SIDES)
    return (
        "Of the band that it predicts without a simulation, the short edge lies within the "
        f"interval of the computed one on {short}, the long edge on {long}."
    )


def _where(named: xr.Dataset, chosen: xr.DataArray) -> str:
    surfaces = named["surface"].values[chosen.values]
    return labels(named, surfaces) if len(surfaces) else "no surface"


def clause_of_laws(laws: xr.Dataset) -> str:
    """Return which laws move an edge of the mean band beyond its interval."""
    moved = differs_from_one(laws.sel(group=POOLED), "edge_factor")
    said = [
        f"the {name} edge of {laws['law_label'].sel(law=law).item()}"
        for law in laws["law"].values
        for side, name in EDGE_NAMES.items()
        if law != EXPONENTIAL.name and moved.sel(law=law, side=side)
    ]
    which = f"{listed(said)} alone" if said else "none"
    return f"Edges of the mean band that differ from that of Eq. 1 beyond their intervals: {which}."


def clause_of_maps(maps: xr.Dataset) -> str:
    """Return how sure the forces are that the band compares."""
    needed = maps["scans_needed"].sel(rho=maps.attrs["reference_rho"]).values
    if np.isnan(needed).all():
        return "How sure the forces are that the band compares, one scan of each does not tell."
    least, most = (
        print_as_paper(end, "1", digits=DIGITS) for end in (np.nanmin(needed), np.nanmax(needed))
    )
    return (
        "The band compares forces on the same surfaces with and without some roughness, so that "
        "part of the scatter between scans cancels; the forces themselves need "
        f"{least} to {most} scans to be known within {print_percent(maps.attrs['tolerance'])}."
    )


def clause_of_repeated_contact(repeated_contact: xr.Dataset) -> str:
    """Return where repeated contact changes the forces that the band compares."""
    of_study = repeated_contact.sel(preload=repeated_contact["preload"].min())
    changed = differs_from_one(of_study, "mean_ratio")
    follows = "" if changed.any() else ": nothing speaks for another band"
    return (
        "Repeated contact changes the mean forces that the band compares, beyond their intervals, "
        f"on {_where(repeated_contact, changed)}{follows}."
    )


def clause_of_elastic_limit(elastic_limit: xr.Dataset) -> str:
    """Return where the band may take every contact as plastic."""
    open_, yielding = disputed(elastic_limit), amounts(elastic_limit["plastic_share"])
    names = elastic_limit["label"].values
    said = [
        f"{verb} on {listed(names[chosen])}"
        for verb, chosen in (
            ("holds", (yielding == "all") & ~open_),
            ("does not hold", (yielding != "all") & ~open_),
            ("is not decided", open_),
        )
        if chosen.any()
    ]
    return f"The band takes every contact as plastic, which {listed(said)}."
