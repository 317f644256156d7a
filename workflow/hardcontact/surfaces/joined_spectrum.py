"""One spectrum of a surface from all its measurements: maps of several sizes, line scans.

It is continued beyond its band within bounds on slope and curvature. xarray is imported where it is
used.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hardcontact.numbers.printing import print_number
from hardcontact.surfaces.measured_spectrum import (
    bias_of_log,
    independent_waves,
    local_slopes,
    measured_psd,
    size_of,
    variance_of_log,
)
from hardcontact.surfaces.measurement import Measurement
from hardcontact.surfaces.reliable_band import ReliableBand, band_of_psd
from hardcontact.surfaces.spectral_models import power_law_tail
from hardcontact.surfaces.spectrum import BIN_CENTRES, WAVEVECTORS, Spectrum, spectrum_dataset

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

#: Relative standard deviation of C_iso between measurements that no number of waves makes smaller:
#: the heights of microscopes are calibrated to about ten per cent. It keeps a measurement of many
#: waves from silencing the others.
CALIBRATION = 0.2
#: Bins that a joined spectrum has at least.
FEWEST = 3
#: The shortest wave of a row of atoms in nm: two bonds of diamond, 0.154 nm each.
ATOMIC = 0.3
#: The largest rms gradient, and half-Laplacian in 1/nm, over all scales: those of UNCD, the
#: roughest hard surface of Table 1 of the paper, with their uncertainties (1.17 + 0.28, 6.32 +
#: 1.20). A sphere of such a curvature has the radius of an atom.
GRADIENT, HALF_LAPLACIAN = 1.45, 7.52
#: H is fitted to C_iso flatter than q^-2 nowhere: this is the plateau or its roll-off.
FLATTEST = -2.0


class _Part(NamedTuple):
    """What one measurement gives: its radius of tip (nm), band, C_iso in nm⁴, waves, reliability.

    The last three are over (bins,).
    """

    measurement: Measurement
    tip_radius: float | None
    band: ReliableBand
    density: Floats
    waves: Floats
    reliable: NDArray[np.bool_]


def joined_spectrum(
    measurements: Sequence[Measurement], tip_radii: Sequence[float | None]
) -> "xr.Dataset":
    """Return the spectrum of a surface, joined of its measurements within their reliable bands.

    Parameters
    ----------
    measurements : sequence of Measurement
        All of one surface.
    tip_radii : sequence of float or None
        In nm, of each measurement; None: that which its file states, if any.

    Returns
    -------
    xarray.Dataset
        `spectrum` (wavevector) in nm⁴ over all scales; `joined` (bin_wavevector) in nm⁴, the mean
        logarithm of what is reliable, weighted by independent waves and freed of the bias of the
        logarithm, NaN where nothing is; `psd` and `reliable` (measurement, bin_wavevector), and
        what is known of each measurement.

    Raises
    ------
    ValueError
        In one line, if fewer than three bins of wavelengths are reliable.
    """
    parts = [
        _part(measurement, measurement.tip_radius if radius is None else radius)
        for measurement, radius in zip(measurements, tip_radii, strict=True)
    ]
    joined, variance = _log_mean(parts)
    known = np.isfinite(joined)
    if known.sum() < FEWEST:
        raise ValueError(_too_few(parts, int(known.sum())))
    spectrum, note = continued_spectrum(BIN_CENTRES[known], joined[known], variance[known])
    bands = [part.band for part in parts if part.reliable.any()]
    return (
        spectrum_dataset(spectrum)
        .assign(_of_measurements(parts))
        .assign(joined=("bin_wavevector", joined, {"units": "nm4", "long_name": "joined PSD"}))
        .assign_coords(bin_wavevector=("bin_wavevector", BIN_CENTRES, {"units": "rad nm-1"}))
        .assign_attrs(
            basis="measured",
            calibrated_to_table1="",
            shortest_measured=min(band.shortest for band in bands),
            longest_measured=max(band.longest for band in bands),
            tail_note="; ".join([note, *_gaps(bands)]),
        )
    )


def _part(measurement: Measurement, tip_radius: float | None) -> _Part:
    """Return C_iso of one measurement and where it is reliable."""
    _, density = measured_psd(measurement)
    band = band_of_psd(measurement, tip_radius, density)
    wavelength = 2 * np.pi / BIN_CENTRES
    reliable = (band.shortest <= wavelength) & (wavelength <= band.longest) & np.isfinite(density)
    return _Part(measurement, tip_radius, band, density, independent_waves(measurement), reliable)


def _log_mean(parts: Sequence[_Part]) -> tuple[Floats, Floats]:
    """Return the weighted mean of ln C as C in nm⁴, NaN where nothing is, and its variance (bins,).

    Each measurement counts by the inverse of its variance, by its waves and its calibration, and
    ln C is raised by what the logarithm of few waves lies too low on average.
    """
    reliable, density, waves = (
        np.array([getattr(part, name) for part in parts])
        for name in ("reliable", "density", "waves")
    )
    weight = np.where(reliable, 1 / (variance_of_log(waves) + CALIBRATION**2), 0.0)
    total = weight.sum(axis=0)
    logs = np.where(reliable, np.log(density) + bias_of_log(waves), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.exp((weight * logs).sum(axis=0) / total), 1 / total


def _too_few(parts: Sequence[_Part], count: int) -> str:
    """Return the line that refuses measurements with too few reliable bins."""
    found = "; ".join(
        f"{_name(part.measurement)} from {print_number(part.band.shortest)} nm "
        f"({part.band.shortest_reason}) to {print_number(part.band.longest)} nm "
        f"({part.band.longest_reason})"
        for part in parts
    )
    return (
        f"expected measurements that are reliable in at least {FEWEST} bins of wavelengths (ten a "
        f"decade), found {count}: {found}"
    )


def _name(measurement: Measurement) -> str:
    return f"{measurement.path} {measurement.dataset}".strip()


def _gaps(bands: Sequence[ReliableBand]) -> list[str]:
    """Return words for the wavelengths between the bands that no measurement reaches."""
    texts, reached = list[str](), 0.0
    for band in sorted(bands, key=lambda one: one.shortest):
        if reached and band.shortest > reached:
            texts.append(
                f"between {print_number(reached)} and {print_number(band.shortest)} nm interpolated"
            )
        reached = max(reached, band.longest)
    return texts


def _of_measurements(parts: Sequence[_Part]) -> dict[str, Any]:
    """Return the variables over measurement, as they are stored."""
    nm = {"units": "nm"}
    columns: dict[str, tuple[list[Any], dict[str, str]]] = {
        "kind": ([part.measurement.kind for part in parts], {}),
        "size": ([size_of(part.measurement) for part in parts], nm),
        "pixel_size": ([part.measurement.pixel_size for part in parts], nm),
        "shortest_reliable": ([part.band.shortest for part in parts], nm),
        "longest_reliable": ([part.band.longest for part in parts], nm),
        "shortest_reason": ([part.band.shortest_reason for part in parts], {}),
        "longest_reason": ([part.band.longest_reason for part in parts], {}),
        "path": ([part.measurement.path for part in parts], {}),
        "dataset": ([part.measurement.dataset for part in parts], {}),
        "tip_radius": (
            [np.nan if part.tip_radius is None else part.tip_radius for part in parts],
            nm,
        ),
        "notes": (["; ".join(part.measurement.notes) for part in parts], {}),
    }
    both = ("measurement", "bin_wavevector")
    density, reliable = (
        [getattr(part, name) for part in parts] for name in ("density", "reliable")
    )
    return {
        "psd": (both, np.array(density), {"units": "nm4", "long_name": "isotropic PSD"}),
        "reliable": (both, np.array(reliable, "int8"), {"long_name": "1 where it is reliable"}),
        **{name: ("measurement", values, attrs) for name, (values, attrs) in columns.items()},
    }


def stacked_spectra(
    of_surface: Mapping[str, "xr.Dataset"], labels: Mapping[str, str]
) -> "xr.Dataset":
    """Return the joined spectra of all surfaces, given by surface, with their names in print.

    The variables of `joined_spectrum` have a leading dimension `surface`, filled with NaN, 0 or ""
    where a surface has fewer measurements than another; `label`, `shortest_measured`,
    `longest_measured` (nm) and `tail_note` (surface) stand beside them.
    """
    import pandas as pd
    import xarray as xr

    most = max(one.sizes["measurement"] for one in of_surface.values())
    padded = [_padded(one, most) for one in of_surface.values()]
    names = pd.Index(list(of_surface), name="surface")
    stacked = xr.concat(padded, names, combine_attrs="drop")
    attrs = [one.attrs for one in of_surface.values()]
    lengths: dict[str, Any] = {
        name: ("surface", [one[name] for one in attrs], {"units": "nm"})
        for name in ("shortest_measured", "longest_measured")
    }
    return stacked.assign(
        **lengths,
        label=("surface", [labels[name] for name in of_surface]),
        tail_note=("surface", [one["tail_note"] for one in attrs]),
    )


def _padded(spectrum: "xr.Dataset", measurements: int) -> "xr.Dataset":
    """Return a joined spectrum with empty measurements at its end."""
    empty: dict[Any, Any] = {
        name: {"U": "", "O": "", "i": 0}.get(values.dtype.kind, np.nan)
        for name, values in spectrum.data_vars.items()
    }
    missing = measurements - spectrum.sizes["measurement"]
    return spectrum.pad(measurement=(0, missing), constant_values=empty)


def continued_spectrum(wavevector: Floats, density: Floats, variance: Floats) -> tuple[Floats, str]:
    """Return C_iso (nm⁴) on WAVEVECTORS from measured points, and in words how it was continued.

    The points are wavevectors (rad/nm), C_iso (nm⁴) and the variance of ln C, at least three,
    without gaps. Above the longest wavelength measured C_iso is constant. Below the shortest it is
    self-affine with the Hurst exponent of the last decade past the roll-off, held within 0 to 1.
    The tail ends at the distance of atoms, or where the rms gradient or half-Laplacian of all
    scales would pass that of the roughest hard surface known: there is none if the measured part
    alone does.
    """
    # A point of the table at the last wavevector may lie beyond it by rounding.
    table = Spectrum(wavevector, density)(np.minimum(WAVEVECTORS, wavevector[-1]))
    measured = np.where(wavevector[-1] * (1 + 1e-9) >= WAVEVECTORS, table, 0.0)
    hurst, count = _hurst(wavevector, density, variance)
    # The tail begins with the log-mean of the last points along it.
    relative = wavevector[-FEWEST:] / wavevector[-1]
    level = float(np.exp(np.mean(np.log(density[-FEWEST:] * relative ** (2 + 2 * hurst)))))
    last = measured.nonzero()[0][-1]
    start = measured.copy()
    start[last] = level * (WAVEVECTORS[last] / wavevector[-1]) ** (-2 - 2 * hurst)
    tail = power_law_tail(start, hurst, ATOMIC)
    ends, reason = _bounded(measured + tail)
    spectrum = np.where(np.arange(len(WAVEVECTORS)) <= max(ends, last), measured + tail, 0.0)
    if ends <= last:
        return spectrum, f"no roughness was added below the wavelengths measured: {reason}"
    short, long = 2 * np.pi / wavevector[[-1, -count]]
    return spectrum, (
        f"below the wavelengths measured, artificial: self-affine with H = {hurst:.2f}, fitted "
        f"from {print_number(short)} to {print_number(long)} nm and held within 0 to 1, "
        f"ending at {2 * np.pi / WAVEVECTORS[ends]:.2g} nm: {reason}"
    )


def _hurst(wavevector: Floats, density: Floats, variance: Floats) -> tuple[float, int]:
    """Return the Hurst exponent of the last decade past the roll-off, and its number of points."""
    slopes, error = local_slopes(wavevector, density, variance)
    fitted = wavevector >= wavevector[-1] / 10 * (1 - 1e-9)
    flat = np.flatnonzero(slopes - error > FLATTEST)
    if flat.size:
        fitted[: flat[-1] + 1] = False
    fitted[-FEWEST:] = True
    weight = 1 / np.sqrt(variance[fitted])
    slope = np.polyfit(np.log(wavevector[fitted]), np.log(density[fitted]), 1, w=weight)[0]
    return float(np.clip(-slope / 2 - 1, 0, 1)), int(fitted.sum())


def _bounded(density: Floats) -> tuple[int, str]:
    """Return the last index of WAVEVECTORS within the bounds, and what ends the spectrum there."""
    gradient, half_laplacian = (
        np.sqrt(_sums(density * WAVEVECTORS**power / divisor / (2 * np.pi)))
        for power, divisor in ((4, 1), (6, 4))
    )
    ends = {
        f"the rms gradient of all scales reaches {GRADIENT}": gradient > GRADIENT,
        f"the rms curvature of all scales reaches {HALF_LAPLACIAN} per nm": (
            half_laplacian > HALF_LAPLACIAN
        ),
        "atoms are no closer": density == 0,
    }
    first = {
        reason: int(np.argmax(np.append(beyond, True)))  # where no wave is beyond: after the last
        for reason, beyond in ends.items()
    }
    reason = min(first, key=first.__getitem__)
    return first[reason] - 1, reason


def _sums(integrand: Floats) -> Floats:
    """Return the integral over ln q up to each point of WAVEVECTORS, by trapezoids."""
    steps = (integrand[1:] + integrand[:-1]) / 2 * np.diff(np.log(WAVEVECTORS))
    return np.append(0.0, np.cumsum(steps))
