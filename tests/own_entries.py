"""Entries of an inventory, as scans of any size would give them, and a proposal's configuration."""

import numpy as np
from random_scans import uncd
from repository import PAPER

from hardcontact.commands.inventory import Entry
from hardcontact.commands.new import nested
from hardcontact.commands.proposal import Choice
from hardcontact.commands.request import Source
from hardcontact.config.limits import check_grids
from hardcontact.config.model import configuration
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.reliable_band import ReliableBand
from hardcontact.surfaces.spectrum import BIN_CENTRES

#: Width of a bin in ln q.
BIN = np.log(10) / 10


def density(size, pixel, rms):
    """C_iso (bins,) in nm4 of an rms height, between two pixels and the size of a scan."""
    wavelength = 2 * np.pi / BIN_CENTRES
    values = uncd(BIN_CENTRES)
    values[(wavelength < 2 * pixel) | (wavelength > size)] = np.nan
    return values * (rms / np.sqrt(np.nansum(values * BIN_CENTRES**2) * BIN / (2 * np.pi))) ** 2


def entry(size=2500.0, pixels=512, rms=17.0, **others):
    """Return a height map of a surface `a`; other fields as they are named."""
    pixel = size / pixels
    name = others.pop("surface", "a")
    path = others.pop("path", "scans/one.nc")
    fields = {
        "dataset": "", "channel": "height", "file_unit": "nm", "kind": "map",
        "peak_to_valley": 6 * rms, "relief": 8 * rms, "tip_radius": None, "tip_given": False,
        "band": ReliableBand(4 * pixel, size / 3, "pixels"),
        "density": density(size, pixel, rms), "undefined": 0, "notes": (),
    }  # fmt: skip
    return Entry(
        source=Source(name, name, path, path), pixels=pixels, pixel_size=pixel, rms_height=rms,
        **(fields | others),
    )  # fmt: skip


def probe(radius=250e3, preload=1e-5, hardness=25e9, rho=5.6):
    """Return a sphere and its load; the paper's, if nothing else is said."""
    return Contact(radius=radius, preload=preload, hardness=hardness, range=rho)


def numbers(asked, choices):
    """Return the configuration of choices for what was asked, as the study reads it."""

    named = [
        Choice("study", "own", ""),
        Choice("published", "none", ""),
        Choice("sphere.surface", "smooth", ""),
        Choice("sphere.radius", f"{asked.radius:.12g} nm", ""),
        Choice("contact.preload", f"{asked.preload:.12g} N", ""),
        Choice("contact.hardness", f"{asked.hardness:.12g} Pa", ""),
    ]

    return configuration(nested([*named, *choices], PAPER))


def both_efforts(asked, proposal):
    """Return the configurations of a proposal: of the study and of its quick effort."""
    choices = proposal.choices
    return [numbers(asked, choices), numbers(asked, [*choices, *proposal.quick])]


def check_study(asked, proposal):
    """Let the checks of the study look at a proposal for a smooth sphere, at both efforts."""
    grids = {}
    for scan in proposal.contact:
        name = scan.source.surface
        relief = max(scan.relief, grids[name].relief if name in grids else 0)
        grids[name] = scan.grid._replace(relief=relief)
    for config in both_efforts(asked, proposal):
        check_grids(config, grids)
