"""Contacts on windows that are cut out of small surfaces."""

LOAD = {"preload": 10e-6, "hardness": 25e9}
RANGES = [2.0, 5.0]


def contacts_on(size, radius, windows):
    """Return the contacts of a sphere (radius in nm) on two windows of each of these edges (nm).

    The analysis window is as wide as the whole surface, whose edge is `size`.
    """
    return {
        "sizes": windows,
        "each": 2,
        "radius": radius,
        "ranges": RANGES,
        "window": size,
        "count": 2,
        **LOAD,
    }
