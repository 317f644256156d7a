"""Defects of a scan that make forces wrong although its file is read without an error.

Spikes, lines that were not measured, a clipped range, a curvature that levelling leaves, a lay,
edges.
"""

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.base.printing import print_length, print_share
from hardcontact.surfaces.spectrum import Floats


class Defect(NamedTuple):
    """A defect of scans: its numbers with their units, and a sentence that holds them."""

    units: Mapping[str, str]
    sentence: str  #: Has the numbers in braces; it stands after the name of the scan.


#: The defects by their code.
DEFECTS = {
    "spikes": Defect(
        {"spike_share": "1", "rms_height_without_spikes": "nm"},
        "{spike_share} of its pixels are spikes, more than {spike:g} rms heights from those around "
        "them; without them the rms height is {rms_height_without_spikes}: remove them",
    ),
    "equal_lines": Defect(
        {"equal_line_share": "1"},
        "{equal_line_share} of its lines are constant or equal to the one before, as of a scan "
        "that was stopped: crop it",
    ),
    "highest": Defect(
        {"highest_share": "1"},
        "{highest_share} of its pixels have the highest value, as of a clipped range: the summits "
        "that touch are cut off",
    ),
    "lowest": Defect(
        {"lowest_share": "1"},
        "{lowest_share} of its pixels have the lowest value, as of a clipped range",
    ),
    "curvature": Defect(
        {"curvature_radius": "nm", "uncurved_share": "1"},
        "levelling leaves a curvature of radius {curvature_radius}, as of a ball or the bow of a "
        "scanner, without which {uncurved_share} of the rms height remains: --levelling quadratic "
        "(scan.levelling: quadratic) subtracts it",
    ),
    "lay": Defect(
        {"lay_ratio": "1"},
        "the variance of profiles along one direction is {lay_ratio} times that across (a lay, a "
        "grating, a step, offset lines): closed forms and roughness beyond the scans are alike in "
        "all directions",
    ),
    "edges": Defect(
        {"edge_slope_share": "1"},
        "{edge_slope_share} of its squared slopes lie on {edge_pixels} of its pixels, as of "
        "pillars or steps: closed forms and roughness beyond the scans have no such edges",
    ),
}
#: The numbers of all defects with their units.
DEFECT_UNITS = {name: unit for defect in DEFECTS.values() for name, unit in defect.units.items()}

#: Rms heights between a spike and its neighbours. Gaussian heights exceed six once in 10⁹ pixels.
SPIKE = 6.0
#: Median distance of Gaussian heights from their median, in rms heights.
MEDIAN_DISTANCE = 0.6745
#: Share of lines whose area changes a mean force little.
FEW_LINES = 0.01
#: Pixels at an end of the range. More than one in a thousand, and more than ten, are no summit.
#: The last level of quantised heights holds fewer pixels than the next one; that of a flat summit,
#: whose height falls with the fourth power of the distance, 2.4 times as many.
END_SHARE, END_PIXELS, END_RATIO = 1e-3, 10, 3.0
#: Share of the rms height that roughness beside a curvature has at most: a tenth is curvature.
UNCURVED = 0.9
#: Power of the polynomials of second order over that of third and fourth order. By the longest
#: waves of self-affine surfaces, without a roll-off, it reached 34 in 8100 maps (H from 0.5 to 1).
SECOND_ORDER = 50.0
#: Points along an edge that polynomials are fitted to.
FITTED_POINTS = 32
#: Variance of profiles along a lay's wavevector over that across, and its share of the variance of
#: heights, below which drift and noise of lines count. Of 5400 self-affine maps without a roll-off
#: (H from 0.5 to 1) two pass both. Profiles have waves of at least four pixels, below which lines
#: are noisy, and at least four in a size: there are few random ones that are longer.
LAY_RATIO, LAY_SHARE, PIXELS, MIN_WAVES = 3.0, 0.1, 4, 4
#: Share of the pixels that are edges, and of the squared slopes that they have at least. Of rough
#: surfaces 5 % of the pixels have 0.2 to 0.45 of the squared slopes, of pillars and steps 0.8 to 1.
EDGE_PIXELS, EDGE_SHARE = 0.05, 0.7
#: Stands for an infinite ratio, of a pattern without noise.
LARGEST_RATIO = 1e6


def scan_defects(
    as_read: Floats, levelled: Floats, pixel_size: float
) -> dict[str, dict[str, float]]:
    """Return the defects of a scan by code, each with its numbers as in DEFECTS.

    Parameters
    ----------
    as_read, levelled : array
        Heights in nm, (y, x) of a map or (n,) of a line scan: as in the file, and levelled.
    pixel_size : float
        In nm; of a line scan its spacing.
    """
    numbers = {"spikes": _spikes(levelled)}
    measured = as_read
    if as_read.ndim == 2:
        rows, columns = _equal_lines(as_read), _equal_lines(as_read.T)
        share = float(max(rows.mean(), columns.mean()))
        numbers["curvature"] = _curvature(levelled, pixel_size)
        if share > FEW_LINES:
            numbers["equal_lines"] = [share]
            measured = as_read[~rows][:, ~columns]
        else:  # Lines that were not measured are no lay.
            numbers["lay"] = _lay(levelled)
    numbers["highest"], numbers["lowest"] = _clipped(measured)
    if not numbers["spikes"] and "equal_lines" not in numbers:
        numbers["edges"] = _edges(levelled)
    return {
        code: dict(zip(defect.units, numbers[code], strict=True))
        for code, defect in DEFECTS.items()
        if numbers.get(code)
    }


def _spikes(heights: Floats) -> list[float]:
    """Return the share of spikes and the rms height (nm) without them, or nothing without any.

    On a map a neighbour of a spike may be one, too. A pixel at the corner of a particle has three
    neighbours on it.
    """
    isolation = _isolation(heights)
    # Spikes raise the rms height: suspects are left out, found by the median distance.
    distance = np.median(np.abs(heights - np.median(heights)))
    rms_height = float(heights[isolation <= SPIKE * distance / MEDIAN_DISTANCE].std())
    share = float((isolation > SPIKE * rms_height).mean())
    return [share, rms_height] if share else []


def _isolation(heights: Floats) -> Floats:
    """Return how far each height is from the nearest one around it, on a map the second nearest."""
    padded = np.pad(heights, 1, constant_values=np.inf)
    nearest = second = np.full(heights.shape, np.inf)
    for start in product(range(3), repeat=heights.ndim):
        if set(start) == {1}:
            continue
        window = (slice(i, i + count) for i, count in zip(start, heights.shape, strict=True))
        distance = np.abs(padded[tuple(window)] - heights)
        second = np.minimum(second, np.maximum(nearest, distance))
        nearest = np.minimum(nearest, distance)
    return second if heights.ndim == 2 else nearest


def _equal_lines(lines: Floats) -> NDArray[np.bool_]:
    """Return which lines (y,) of a map are constant, or equal to the one before."""
    equal = np.asarray(np.ptp(lines, axis=1) == 0)
    equal[1:] |= (lines[1:] == lines[:-1]).all(axis=1)
    return equal


def _clipped(heights: Floats) -> list[list[float]]:
    """Return the shares of pixels at the highest and the lowest value, or nothing if few."""
    _, counts = np.unique(heights, return_counts=True)
    if len(counts) < 2:
        return [[], []]
    shares: list[list[float]] = []
    for end, beside in (counts[::-1][:2], counts[:2]):
        share = float(end / heights.size)
        is_clipped = share > END_SHARE and end > max(END_RATIO * beside, END_PIXELS)
        shares.append([share] if is_clipped else [])
    return shares


def _curvature(heights: Floats, pixel_size: float) -> list[float]:
    """Return the radius (nm) of a curvature and the share of the rms height without it, if any."""
    step = max(1, len(heights) // FITTED_POINTS)
    points = heights[::step, ::step]
    axis = np.linspace(-1, 1, len(points))
    powers = np.array([(order - j, j) for order in range(5) for j in range(order + 1)])
    terms = [np.outer(axis**i, axis**j).ravel() for i, j in powers]
    polynomials, triangle = np.linalg.qr(np.transpose(terms))
    amplitudes = polynomials.T @ points.ravel()
    orders = powers.sum(axis=1)
    power = [float((amplitudes[orders == order] ** 2).sum()) for order in range(5)]
    total = float((points**2).sum()) - power[0] - power[1]
    uncurved_power = max(total - power[2], 0.0)
    if uncurved_power >= UNCURVED**2 * total or power[2] < SECOND_ORDER * (power[3] + power[4]):
        return []
    terms_of_order = np.linalg.solve(triangle, np.where(orders == 2, amplitudes, 0))
    yy, xy, xx = terms_of_order[orders == 2]
    half_edge = (len(points) - 1) * step * pixel_size / 2
    curvatures = np.linalg.eigvalsh([[2 * yy, xy], [xy, 2 * xx]]) / half_edge**2
    return [float(1 / np.abs(curvatures).max()), float(np.sqrt(uncurved_power / total))]


def _lay(heights: Floats) -> list[float]:
    """Return the ratio of the variances of profiles along and across a lay, or nothing without."""
    pixels = len(heights)
    window = np.hanning(pixels + 1)[:-1]
    power = np.abs(np.fft.fft2(heights * np.outer(window, window))) ** 2
    waves = np.fft.fftfreq(pixels, 1 / pixels)
    wavevector = waves + 1j * waves[:, None]  # x + iy, in waves along an edge
    size = np.abs(wavevector)
    resolved = (MIN_WAVES <= size) & (size <= pixels / PIXELS)
    # Opposite wavevectors have the same square.
    squares = (power[resolved] * (wavevector[resolved] / size[resolved]) ** 2).sum()
    direction = np.exp(0.5j * np.angle(squares))
    variances = []
    for axis in (direction, 1j * direction):
        component = np.abs((wavevector * np.conj(axis)).real)
        profile = (MIN_WAVES <= component) & (component <= pixels / PIXELS)
        variances.append(float(power[profile].sum()))
    along, across = variances
    is_lay = along > LAY_RATIO * across and along > LAY_SHARE * power.sum()
    return [along / max(across, along / LARGEST_RATIO)] if is_lay else []


def _edges(heights: Floats) -> list[float]:
    """Return the share of the squared slopes at the steepest pixels, or nothing without edges."""
    if heights.ndim == 2:
        squares = np.diff(heights, axis=0)[:, 1:] ** 2 + np.diff(heights, axis=1)[1:] ** 2
    else:
        squares = np.diff(heights) ** 2
    squares = np.sort(squares, axis=None)
    steepest = squares[-max(1, round(EDGE_PIXELS * squares.size)) :]
    share = float(steepest.sum() / squares.sum())
    return [share] if share > EDGE_SHARE else []


def defect_sentence(code: str, numbers: Mapping[str, float]) -> str:
    """Return the sentence on a defect, with its numbers in words and without a full stop."""
    words = {name: _printed(name, number) for name, number in numbers.items()}
    return DEFECTS[code].sentence.format(**words, spike=SPIKE, edge_pixels=print_share(EDGE_PIXELS))


def _printed(name: str, number: float) -> str:
    """Return a number of a defect with its unit, a share in per cent."""
    if DEFECT_UNITS[name] == "nm":
        return print_length(number)
    number = float(f"{number:.2g}")
    return print_share(number) if name.endswith("_share") else f"{number:g}"
