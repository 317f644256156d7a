"""What limits the answer of a surface, in words: its edges, scans, pixels, window, intervals."""

import numpy as np
import xarray as xr

from hardcontact.answer.artificial import (
    artificial_bands,
    measurements,
    reliable_measurements,
    share_inside,
)
from hardcontact.answer.datasets import at_range
from hardcontact.answer.sentences import (
    continued_words,
    differing_sides,
    edge_words,
    is_open,
    printed_continued_force,
)
from hardcontact.numbers.printing import print_length, print_share
from hardcontact.scales.critical_band import computed_cutoffs

#: Neighbouring cutoffs of a larger ratio leave edges between them uncertain: forces change as much.
SPARSE = 2.0

EDGES = {"small": "The short edge of the band", "large": "The long edge of the band"}


def sparse_cutoffs(edges: xr.Dataset) -> list[str]:
    """Return which edges of a surface were found between cutoffs that lie far apart."""
    texts = []
    for side in EDGES:
        shorter, longer = _neighbours(edges.sel(side=side))
        if longer > SPARSE * shorter:
            texts.append(
                f"{EDGES[side]} is read off between the two cutoffs computed beside it, "
                f"{print_length(shorter)} and {print_length(longer)}; where between them it lies "
                f"is interpolated.{_interval(edges.sel(side=side))}"
            )
    return texts


def _interval(of_side: xr.Dataset) -> str:
    """Return what the interval of an edge is, if it has one: not the cutoffs beside it."""
    ends = of_side["edge_interval"].values
    if not np.isfinite(ends).any():
        return ""
    low, high = (print_length(end) if np.isfinite(end) else "an open end" for end in ends)
    return (
        f" Its {print_share(of_side.attrs['confidence'])} interval is another thing: from {low} "
        f"to {high}, as far as the scatter of forces may move it."
    )


def _neighbours(of_side: xr.Dataset) -> tuple[float, float]:
    """Return the cutoffs (nm) between which the edge of one side was found, NaN of an open one."""
    edge = of_side["edge"].item()
    known = computed_cutoffs(of_side["scale_ratio"])
    if np.isnan(edge):
        return np.nan, np.nan
    return float(known[known <= edge].max()), float(known[known >= edge].min())


#: Share of the force on a smooth sphere that a window holds as good as whole.
WHOLE = 0.99

#: Pixels in contact below which their area, a whole number of them, may be off by more than 5 %.
FEW_PIXELS = 10

#: What errors of both signs leave of a force.
OPPOSITE = (
    "The window makes the force too low, the small scan too high; neither error is known well "
    "enough to correct it, so the force is a rough guess."
)


def of_blind_scans(spectra: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return that the scans of the contacts, which their pixels tell, are reliable nowhere."""
    known = measurements(spectra)
    of_contact = (known["kind"].values.astype(str) == "map") & np.isclose(
        known["pixel_size"].values ** 2, force["pixel_area"].item()
    )
    reliable = (known["reliable"].values == 1).any(axis=1)
    if reliable[of_contact].any() or not of_contact.any():
        return []
    return [
        "The scans that contacts are made on are reliable at no wavelength: the force on them says "
        "little of that on the surface."
    ]


def of_window(force: xr.Dataset) -> list[str]:
    """Return that the window holds too little of the force, at the range asked for or others."""
    rho, share = force["rho"].values, force["window_share"].values
    here = at_range(force)
    if here["window_share"] < WHOLE:
        place, where = here["rho"].item(), "Forces"
        held = here["window_share"].item()
    elif (share < WHOLE).any():
        place, held = rho.max(), share.min()
        where = f"From a range of adhesion of {print_length(rho[share < WHOLE].min())} on forces"
    else:
        return []
    return [
        f"{where} come out too low: the window of {print_length(force.attrs['window'])} holds "
        f"{held:.0%} of the force on a smooth sphere at a range of {print_length(place)}."
    ]


def of_scan_size(force: xr.Dataset) -> list[str]:
    """Return that scans are smaller than contacts need, by how much that raises forces."""
    note = str(force["finite_scan_note"].item())
    return [note] if note else []


def of_pixels(force: xr.Dataset) -> list[str]:
    """Return that few pixels carry the preload, or one that is larger than need be."""
    area, pixel = force.attrs["contact_area"], force["pixel_area"].item()
    if area >= FEW_PIXELS * pixel:
        return []
    if area >= pixel:
        return [
            f"The preload is carried by {area:.3g} nm², {area / pixel:.3g} pixels of the scans "
            f"({pixel:.3g} nm²): the area in contact is known to half a pixel at best."
        ]
    return [
        f"The preload is carried by {area:.3g} nm², less than a pixel of the scans "
        f"({pixel:.3g} nm²): one pixel touches, hardness and preload do not matter, and the "
        "shorter the range of adhesion, the more of the force is that of this pixel."
    ]


#: Measurements that a sentence names.
NAMED = 4

#: Kind of what stands for the measurements of a substitute.
DESCRIPTION = "description"


def limits(basis: str, spectra: xr.Dataset, edges: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return what limits the answer of a surface, the gravest first."""
    return [
        *_of_basis(basis),
        *(text for side in EDGES for text in _of_edge(side, edges)),
        *artificial_edges(spectra, edges),
        *of_blind_scans(spectra, force),
        *of_window(force),
        *of_scan_size(force),
        *_of_continued_roughness(force),
        *of_pixels(force),
        *_of_intervals(edges, force),
        *sparse_cutoffs(edges),
        *_of_spectrum(spectra),
    ]


def grave_limits(spectra: xr.Dataset, edges: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return the limits that change what the answer of a surface says, for its first screen.

    Edges in artificial roughness, contacts on scans that are reliable nowhere or on a single pixel,
    and what changes the force by more than the tolerance of the band.
    """
    tolerance = edges.attrs["tolerance"]
    too_small = force["finite_scan_ratio"].values[0] > 1 + tolerance
    cut = at_range(force)["window_share"].item() < 1 - tolerance
    return [
        *artificial_edges(spectra, edges),
        *of_blind_scans(spectra, force),
        *(of_window(force) if cut else []),
        *(of_scan_size(force) if too_small else []),
        *([OPPOSITE] if cut and too_small else []),
        *(of_pixels(force) if force.attrs["contact_area"] < force["pixel_area"] else []),
    ]


def artificial_edges(spectra: xr.Dataset, edges: xr.Dataset) -> list[str]:
    """Return which edges of a surface, or their intervals, lie where no scan reaches."""
    bands = artificial_bands(spectra)
    places = {side: place_of_edge(edges.sel(side=side), bands) for side in EDGES}
    inside, partly = (
        [EDGES[side] for side, found in places.items() if found == place]
        for place in ("inside", "partly")
    )
    texts = []
    if inside:
        names, verb = (inside[0], "lies") if len(inside) == 1 else ("Both edges of the band", "lie")
        texts.append(
            f"{names} {verb} at wavelengths where no scan is reliable: roughness there is "
            "uncertain or artificial."
        )
    texts += [
        f"The interval of {name[0].lower()}{name[1:]} reaches wavelengths where no scan is "
        "reliable: roughness there is uncertain or artificial."
        for name in partly
    ]
    return texts


def place_of_edge(of_side: xr.Dataset, bands: list[tuple[float, float]]) -> str:
    """Return whether an edge or its bound lies inside artificial bands, its interval partly."""
    edge = float(of_side["edge"].fillna(of_side["edge_bound"]))
    if share_inside(edge, edge, bands):
        return "inside"
    low, high = of_side["edge_interval"].fillna(edge).values
    return "partly" if share_inside(low, high, bands) else "outside"


def _of_basis(basis: str) -> list[str]:
    if basis != "substitute":
        return []
    return [
        "The surface is a substitute: its scans are synthesised from published statistics, not "
        "measured."
    ]


def _of_edge(side: str, edges: xr.Dataset) -> list[str]:
    """Return that an edge, or an end of its interval, lies beyond what was computed."""
    name, of_side = EDGES[side], edges.sel(side=side)
    if is_open(edges, side):
        return [f"{name} is open: {edge_words(edges, side)}."]
    ends = {"low": "shorter", "high": "longer"}
    status = of_side["interval_status"]
    return [
        f"{name} may lie at {words} wavelengths than were computed: its interval is open there."
        for bound, words in ends.items()
        if status.sel(bound=bound).item() == "open" and np.isfinite(of_side["edge_interval"]).any()
    ]


def _of_continued_roughness(force: xr.Dataset) -> list[str]:
    """Return where the force hangs on roughness that the scans do not show."""
    resting = [
        f"{printed_continued_force(force, side)} rests on roughness {continued_words(force, side)}"
        for side in differing_sides(force)
    ]
    if not resting:
        return []
    return [
        f"The force of {' and that of '.join(resting)}, which the scans of contacts do not show. "
        "No interval counts how uncertain the spectrum of this roughness is."
    ]


def _of_intervals(edges: xr.Dataset, force: xr.Dataset) -> list[str]:
    """Return that intervals are conditional on the scans at hand, or that there are none."""
    texts = [
        f"{name}: {part['interval_note'].item()}."
        for name, part, interval in (
            ("Intervals of the band", edges, "scale_ratio_interval"),
            ("Interval of the mean force", force, "force_interval"),
        )
        if not (part[interval] >= 0).any()
    ]
    if force["conditional"].item() and len(texts) < 2:
        texts.append(
            "Intervals are conditional on the scans at hand: they follow from quarters of these "
            "scans, and other scans of the same surface may differ by more. The contacts of "
            "different quarters feel the same peaks; that the mean forces of quarters correlate by "
            f"{force['correlation_of_parts'].item():.2f} for this reason is taken into account."
        )
    return texts


def _of_spectrum(spectra: xr.Dataset) -> list[str]:
    """Return what bounds the reliable wavelengths, what lies beyond, and which tips are unknown."""
    known = reliable_measurements(spectra)
    finest = known.isel(measurement=int(known["shortest_reliable"].values.argmin()))
    widest = known.isel(measurement=int(known["longest_reliable"].values.argmax()))
    found = [
        f"{_nothing(finest)} below {print_length(finest['shortest_reliable'].item())}: "
        f"{finest['shortest_reason'].item()} ({measurement_name(finest)}).",
        f"{_nothing(widest)} above {print_length(widest['longest_reliable'].item())}: "
        f"{widest['longest_reason'].item()} ({measurement_name(widest)}).",
    ]
    note = str(spectra["tail_note"].item())
    found += [f"How the spectrum is continued where no scan is reliable: {note}."] if note else []
    blind = [
        f"{measurement_name(one)} ({one['shortest_reason'].item()})"
        for one in _single(measurements(spectra))
        if not (one["reliable"].values == 1).any()
    ]
    if blind:
        found.append(f"Reliable at no wavelength, and not in the spectrum: {_listed(blind)}.")
    scans = known.isel(measurement=known["kind"].values.astype(str) != DESCRIPTION)
    unknown = [measurement_name(one) for one in _single(scans) if np.isnan(one["tip_radius"])]
    if unknown:
        found.append(
            "What a blunt tip hides is not known where no tip radius is stated: "
            f"{_listed(unknown)}."
        )
    return found


def _nothing(one: xr.Dataset) -> str:
    """Return what there is not beyond the band of a measurement, or of a description."""
    described = one["kind"].item() == DESCRIPTION
    return "The description has no source" if described else "No scan is reliable"


def _single(known: xr.Dataset) -> list[xr.Dataset]:
    """Return each of several measurements by itself."""
    return [known.isel(measurement=place) for place in range(known.sizes["measurement"])]


def _listed(names: list[str]) -> str:
    """Return some names, and how many more there are."""
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return f"{', '.join(names[:NAMED])}{more}"


def measurement_name(one: xr.Dataset) -> str:
    """Return the file of a measurement and, if it is a container, the dataset in it."""
    path, dataset = (str(one[name].item()) for name in ("path", "dataset"))
    return f"{path}: {dataset}" if dataset else path
