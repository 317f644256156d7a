"""What contacts that repeat at one place of the sphere come to, in sentences of plain text."""

import numpy as np
import xarray as xr

from hardcontact.answer.part_text import NEAR_ONE, print_bounded_as_paper, print_each
from hardcontact.claims.quantity_text import print_as_paper
from hardcontact.statistics import bounds

__all__ = ["repeated_contact_sentences"]

#: Largest sizes of the indents, as in the image and in the dataset, and what they are called.
SIZES = {"depth": "deep", "lateral_size": "wide"}

#: Why small indents do not speak against repeated contact.
LATTICE = (
    "the places lie at equal distances on one mirrored scan: the indents of a summit stand in a "
    "lattice on the sphere and hardly overlap, while the places of the experiment are independent"
)


def repeated_contact_sentences(repeated_contact: xr.Dataset) -> list[str]:
    """Return what repeated contact does to the force, and whether it explains imaged indents.

    Parameters
    ----------
    repeated_contact : xarray.Dataset
        As from `repeated_contact.repeated_contact`, with the published sizes of indents in an image
        as attributes.

    Returns
    -------
    list of str
        The answer first.
    """
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
