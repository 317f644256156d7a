"""What maps of the pull-off force come to, in sentences of plain text."""

import xarray as xr

from hardcontact.answer.part_text import print_each, print_percent
from hardcontact.claims.quantity_text import print_as_paper

__all__ = ["map_sentences"]


def map_sentences(maps: xr.Dataset) -> list[str]:
    """Return how many contacts and scans a mean force needs, and what a whole scan is worth.

    Parameters
    ----------
    maps : xarray.Dataset
        As from `surface_maps.maps_of_surfaces`.

    Returns
    -------
    list of str
        The answer first.
    """
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
