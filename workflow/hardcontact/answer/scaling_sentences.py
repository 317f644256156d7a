"""What decides the edges of the critical band, in sentences of plain text."""

import xarray as xr

from hardcontact.adhesion.edge_scaling import DEPENDENCE, LENGTHS, PARTS
from hardcontact.answer.part_text import listed, print_bounded_as_paper, print_percent
from hardcontact.claims.quantity_text import print_as_paper

__all__ = ["scaling_sentences"]

EDGES = {"small": "short", "large": "long"}
#: Lengths as they are printed.
NAMES = dict(zip(LENGTHS, ("√R", "√ρ", "√(F/H)"), strict=True))


def scaling_sentences(scaling: xr.Dataset) -> list[str]:
    """Return what both edges follow, their exponents, and how many edges there are.

    Parameters
    ----------
    scaling : xarray.Dataset
        As from `edge_scaling.edge_scaling`, with the attributes ``sphere_radius``, ``rho`` (nm) and
        ``area`` (nm²) of the paper.

    Returns
    -------
    list of str
        The answer first.
    """
    of_sides = (_followed(scaling, side) for side in EDGES)
    exponents = (_exponents(scaling, side, length) for side in EDGES for length in LENGTHS)
    return [
        f"{' '.join(of_sides)} Varied were {_varied(scaling)}.",
        *exponents,
        *(_of_reach(scaling, part) for part in PARTS[1:]),
        _at_paper(scaling),
        _found(scaling),
    ]


def _each(scaling: xr.Dataset, name: str) -> str:
    """Return a number of every surface, with its interval."""
    return "; ".join(
        f"{of_surface['label'].item()} {print_bounded_as_paper(of_surface, name, '1')}"
        for of_surface in (scaling.sel(surface=surface) for surface in scaling["surface"].values)
    )


def _followed(scaling: xr.Dataset, side: str) -> str:
    of_side = scaling.sel(side=side, part=PARTS[0])
    lengths = []
    for length, name in NAMES.items():
        verdicts = of_side["dependence"].sel(length=length).values
        said = [
            f"{verdict} on {listed(of_side['label'].values[verdicts == verdict].tolist())}"
            for verdict in DEPENDENCE
            if (verdicts == verdict).any()
        ]
        lengths.append(f"{name} {', '.join(said)}")
    return f"Whether the {EDGES[side]} edge of the band follows: {'; '.join(lengths)}."


def _varied(scaling: xr.Dataset) -> str:
    said = []
    for name, of in (("radius", "radii"), ("rho", "ranges"), ("area", "contact areas")):
        unit = "nm2" if name == "area" else "nm"
        first, last = (print_as_paper(scaling[name].values[end], unit) for end in (0, -1))
        said.append(f"{of} from {first} to {last}")
    return listed(said)


def _exponents(scaling: xr.Dataset, side: str, length: str) -> str:
    of_length = scaling.sel(side=side, part=PARTS[0], length=length)
    return (
        f"Exponent of the {EDGES[side]} edge against {NAMES[length]}, 1 if it is proportional and "
        f"0 if independent: {_each(of_length, 'exponent')}."
    )


def _of_reach(scaling: xr.Dataset, part: str) -> str:
    of_part = scaling.sel(side="large", part=part)
    return (
        f"Exponent of the long edge against the reach √(2Rρ) of the attraction, "
        f"{part.removeprefix('reach ')}: {_each(of_part, 'reach_exponent')}."
    )


def _at_paper(scaling: xr.Dataset) -> str:
    nearest = {"radius": scaling.attrs["sphere_radius"]} | {
        name: scaling.attrs[name] for name in ("rho", "area")
    }
    at_paper = scaling.sel(nearest, method="nearest")
    said = []
    for surface in at_paper["surface"].values:
        of_surface = at_paper.sel(surface=surface)
        short, long = (
            print_bounded_as_paper(of_surface.sel(side=side), "edge", "nm") for side in EDGES
        )
        said.append(f"{of_surface['label'].item()} {short} and {long}")
    return f"Short and long edge at the paper's sphere, range and load: {'; '.join(said)}."


def _found(scaling: xr.Dataset) -> str:
    number = scaling["edge"].isel(side=0, surface=0).size
    said = []
    for side, name in EDGES.items():
        found = scaling["edges_found"].sel(side=side, part=PARTS[0]).values
        shares = zip(scaling["label"].values, found / number, strict=True)
        fewer = [f"{label} {print_percent(share)}" for label, share in shares if share < 1]
        if fewer:
            said.append(f"the {name} edge ({listed(fewer)})")
    if not said:
        return "Every combination has both edges."
    return (
        f"Not every combination has {listed(said)}: in the others no cutoff changes the force so "
        "much, and exponents say nothing of these."
    )
