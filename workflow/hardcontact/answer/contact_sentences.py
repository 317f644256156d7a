"""Where the bearing area is wrong, in sentences of plain text.

What maps of the pull-off force come to, in sentences of plain text.

What contacts that repeat at one place of the sphere come to, in sentences of plain text.
"""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.answer.part_text import NEAR_ONE, listed, print_each
from hardcontact.numbers.printing import (
    DIGITS,
    print_as_paper,
    print_bounded_as_paper,
    print_percent,
)
from hardcontact.numbers.statistics import bounds

#: Of contacts that yield: by the index of all, and by the pressure of those that were solved.
SHARES = ["plastic_share", "solved_plastic_share"]


def elastic_limit_sentences(elastic_limit: xr.Dataset) -> list[str]:
    """Return for which contacts the bearing area holds, and by how much forces are wrong."""
    return [
        _answer(elastic_limit),
        _shares(elastic_limit),
        _largest(elastic_limit),
        *_forces(elastic_limit),
        *_left_open(elastic_limit),
        _areas(elastic_limit),
    ]


def amounts(share: xr.DataArray) -> NDArray[np.str_]:
    """Return how many contacts of every surface yield: "none", "all", "some", or not known."""
    words = np.where(share == 0, "none", np.where(share == 1, "all", "some"))
    return np.where(np.isnan(share), "", words)


def disputed(limit: xr.Dataset) -> NDArray[np.bool_]:
    """Return for every surface whether index and solved pressure say different things."""
    by_index, solved = (amounts(limit[name]) for name in SHARES)
    return np.asarray((by_index != solved) & (solved != ""))


def _answer(limit: xr.Dataset) -> str:
    open_, yielding = disputed(limit), amounts(limit["plastic_share"])
    names = limit["label"].values
    said = {
        f"{amount} on {listed(names[chosen])}": amount
        for amount in ("none", "some", "all")
        if (chosen := (yielding == amount) & ~open_).any()
    }
    if open_.any():
        said[f"not decided on {listed(names[open_])}, where both disagree"] = ""
    if set(said.values()) & {"none", "some"}:
        answer = "No"
    else:
        answer = "Not decided" if open_.any() else "Yes"
    return (
        f"{answer}. By the rms slope of the gap and by solved elastic pressures these contacts "
        f"yield: {'; '.join(said)}."
    )


def _shares(limit: xr.Dataset) -> str:
    return (
        "The bearing area takes every contact as plastic. By the rms slope of the gap, this share "
        f"of contacts yields: {print_each(limit, 'plastic_share')}; of the contacts whose elastic "
        f"pressure was solved: {print_each(limit, 'solved_plastic_share')}."
    )


def _largest(limit: xr.Dataset) -> str:
    """Return the most by which the mean force of any surface is wrong, up and down."""
    said = []
    for variant, sign, where in (("larger_area", 1, "above"), ("recovered", -1, "below")):
        of_variant = limit.sel(variant=variant)
        ratios = of_variant["force_ratio"].values
        farthest = of_variant.isel(surface=int(np.argmax(sign * ratios)))
        ends = sorted(sign * (end.item() - 1) for end in bounds(farthest, "force_ratio"))
        change = print_percent(sign * (farthest["force_ratio"].item() - 1), *ends)
        said.append(f"at most {change} {where} (on {farthest['label'].item()})")
    return (
        "If the slope tells which contacts yield, mean forces compare with those of the bearing "
        f"area thus: {' and '.join(said)}."
    )


def _forces(limit: xr.Dataset) -> list[str]:
    """Return both ends of the bracket, over the force of the bearing area."""
    ends = {
        "larger_area": "with the larger, elastic area flattened for good",
        "recovered": "with all that does not yield recovered before pull-off",
    }
    return [
        f"Mean force {words}, over that of the bearing area: "
        f"{print_each(limit.sel(variant=variant), 'force_ratio', NEAR_ONE)}."
        for variant, words in ends.items()
    ]


def _left_open(limit: xr.Dataset) -> Iterator[str]:
    """Yield what forces may be where the solved pressures contradict the index."""
    open_ = disputed(limit)
    if open_.any():
        where = limit.isel(surface=open_)
        rigid = print_each(where.sel(variant="rigid"), "force_ratio", NEAR_ONE)
        areas = where["solved_area"].max(["scan", "contact"]).values / limit.attrs["bearing_area"]
        larger = listed(f"{area:.{DIGITS}g}" for area in areas)
        yield (
            f"On {listed(where['label'].values)}, where the solved pressures contradict the slope, "
            f"forces over those of the bearing area may fall to {rigid}, where all contacts "
            f"recover as rigid bodies do, and may rise, as solved areas reach {larger} times the "
            "bearing area."
        )


def _areas(limit: xr.Dataset) -> str:
    factors = limit["estimated_area"].values / limit["solved_area"].values
    known = factors[np.isfinite(factors)]
    low, middle, high = np.quantile(known, [0.05, 0.5, 0.95])
    return (
        f"The elastic area estimated from the slope is {middle:.{DIGITS}g} times the solved one in "
        f"the median of {len(known)} contacts, {low:.{DIGITS}g} to {high:.{DIGITS}g} times in nine "
        "of ten."
    )


def map_sentences(maps: xr.Dataset) -> list[str]:
    """Return how many contacts and scans a mean force needs, and what a whole scan is worth."""
    at_range = maps.sel(rho=maps.attrs["reference_rho"])
    return [_contacts(at_range), _array(at_range), *_scans(at_range), _touched(at_range)]


def _contacts(maps: xr.Dataset) -> str:
    needed = print_each(maps.sel(sampling="random"), "contacts_needed")
    return (
        f"Contacts at random places of one scan that give its mean force within "
        f"{print_percent(maps.attrs['tolerance'])}, {print_percent(maps.attrs['confidence'])} of "
        f"the time, at a range of {print_as_paper(maps.attrs['reference_rho'], 'nm')}: {needed}."
    )


def _array(maps: xr.Dataset) -> str:
    number = int(maps.attrs["array_contacts"])
    if number not in maps["contacts"]:
        return f"Arrays of {number} contacts were not examined on scans of so few pixels."
    errors = maps.attrs["normal_quantile"] * maps["array_error"].sel(contacts=number)
    said = "; ".join(
        f"{label} {print_percent(error)}"
        for label, error in zip(maps["label"].values, errors.values.tolist(), strict=True)
    )
    return f"An array of {number} contacts, as the study has it, tells this mean within {said}."


def _scans(maps: xr.Dataset) -> list[str]:
    if maps["scans_needed"].isnull().all():
        return ["How much scans of one surface differ cannot be told from one scan of each."]
    worth, needed = (print_each(maps, name) for name in ("worth_of_scan", "scans_needed"))
    return [
        f"Scans of one surface differ as well, so that the mean of the surface needs several: "
        f"{needed}.",
        f"To that mean all positions of a scan are worth this many independent contacts: {worth}.",
    ]


def _touched(maps: xr.Dataset) -> str:
    touched = print_each(maps, "touched_pixels")
    return (
        "At each position a rigid sphere rests on one pixel of the scan. The different pixels that "
        f"it rests on at any of the positions are few: {touched}."
    )


#: Largest sizes of the indents, as in the image and in the dataset, and what they are called.
SIZES = {"depth": "deep", "lateral_size": "wide"}

#: Why small indents do not speak against repeated contact.
LATTICE = (
    "the places lie at equal distances on one mirrored scan: the indents of a summit stand in a "
    "lattice on the sphere and hardly overlap, while the places of the experiment are independent"
)


def repeated_contact_sentences(repeated_contact: xr.Dataset) -> list[str]:
    """Return what repeated contact does to the force, and whether it explains imaged indents."""
    last = repeated_contact.isel(stage=-1)
    image = last.sel(preload=last["preload"].max())
    image = image.isel(surface=int(np.argmax(image["mean_ratio"].notnull().values)))
    of_study = last.sel(preload=last["preload"].min())
    first = repeated_contact.isel(stage=0).sel(preload=image["preload"], surface=image["surface"])
    return [
        _force(of_study),
        *(_size(first, image, name) for name in SIZES),
        _growth(first, image),
        "The sphere yields at its hardness and the substrate keeps its shape; recovery, hardening, "
        "wear and any shift of the sphere between contacts are left out.",
    ]


def _force(of_study: xr.Dataset) -> str:
    return (
        f"The mean force of {of_study['stage'].item()} contacts at one place of the sphere, which "
        "keeps its indents, over that of single contacts at the same places of the substrate: "
        f"{print_each(of_study, 'mean_ratio', NEAR_ONE)}."
    )


def _size(first: xr.Dataset, image: xr.Dataset, name: str) -> str:
    """Return one size of the largest indent beside those of the image, and what follows."""
    preload = print_as_paper(image["preload"].item(), "N")
    least, most = image.attrs[f"published_{name}"]
    value, high = image[name].item(), bounds(image, name)[1].item()
    published = " to ".join(print_as_paper(one, "nm") for one in (least, most))
    if np.isnan(high):
        follows = "without an interval nothing is known of whether repeated contact reaches them"
    elif high < least:
        follows = f"whether repeated contact reaches them is not decided, as {LATTICE}"
    elif value < least:
        follows = "the largest is smaller, but its interval reaches them"
    elif value > most:
        follows = "repeated contact goes beyond them"
    elif first[name].item() >= least:
        alone = print_bounded_as_paper(first, name, "nm")
        follows = f"the first contact reaches them already ({alone}), so that this decides nothing"
    else:
        follows = "repeated contact reaches them"
    word, contacts, label = SIZES[name], image["stage"].item(), image["label"].item()
    return (
        f"After {contacts} contacts at {preload} on {label} the largest indent is "
        f"{print_bounded_as_paper(image, name, 'nm')} {word}; those of the published image are "
        f"{published} {word}: {follows}."
    )


def _growth(first: xr.Dataset, image: xr.Dataset) -> str:
    before, after = (
        " and ".join(
            f"{print_as_paper(one[name].item(), 'nm', digits=2)} {word}"
            for name, word in SIZES.items()
        )
        for one in (first, image)
    )
    return (
        f"There the largest indents grow from {before} at the first contact to {after} at the last."
    )
