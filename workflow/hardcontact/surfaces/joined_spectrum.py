"""One spectrum of a surface from all its measurements: maps of several sizes, line scans."""

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from hardcontact.surfaces.extrapolated_spectrum import (
    BIN,
    FEWEST,
    HurstFit,
    LongWaves,
    Tail,
    continued_spectrum,
    fitted_hurst,
    has_exponent,
    with_rolloff,
)
from hardcontact.surfaces.measured_spectrum import (
    CALIBRATION,
    bias_of_log,
    independent_waves,
    local_slopes,
    measured_psd,
    size_of,
    variance_of_log,
)
from hardcontact.surfaces.reliable_band import ReliableBand, reliable_band, with_tip
from hardcontact.surfaces.scan_defects import DEFECT_UNITS
from hardcontact.surfaces.scans import Measurement
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    KNOWN,
    WAVEVECTORS,
    Floats,
    Spectrum,
    spectrum_dataset,
    spectrum_from,
)

#: Radii in nm of tips that are not known: from new ones to blunt ones.
TIPS = (5.0, 50.0)
#: Standard deviation of the change of the slope d ln C/d ln q along a root of a decade: at a
#: roll-off it is 2 + 2H, some 3.6, once in the three decades that surfaces are measured on.
KINK = 2.0
#: Probability of more power in a bin by chance, below which it is that of a line, as of a grating.
LINE = 1e-4
#: The largest change of ln C that is tried to keep the variance of the bins.
MAX_LOG_CHANGE = 20.0
#: What a spectrum says of its ends, with units; it stands in its attributes.
ENDS = dict.fromkeys(("shortest_measured", "longest_measured", "rolloff"), "nm") | dict(
    zip((*Tail._fields, "tail_known"), ("1", "1", "nm", "nm", "1", "1"), strict=True)
)


class _Data(NamedTuple):
    """The measurements of a surface, with their spectra and reliable bands."""

    radii: Sequence[float | None]  #: Of their tips in nm, where they are known.
    densities: Floats  #: (measurement, bins) C_iso in nm⁴, NaN in empty bins.
    waves: Floats  #: (measurement, bins) independent ones.
    bands: Sequence[ReliableBand]
    long_waves: LongWaves

    def reliable(self, bands: Sequence[ReliableBand]) -> NDArray[np.bool_]:
        """Return a mask (measurement, bins) of the bins that are measured within given bands."""
        return np.array([band.bins for band in bands]) & np.isfinite(self.densities)


def _data(measurements: Sequence[Measurement], tip_radii: Sequence[float | None]) -> _Data:
    """Return the data of measurements; raises ValueError for fewer than three reliable bins."""
    radii = [
        measurement.tip_radius if radius is None else radius
        for measurement, radius in zip(measurements, tip_radii, strict=True)
    ]
    densities = np.array([measured_psd(measurement)[1] for measurement in measurements])
    bands = [
        reliable_band(*arguments) for arguments in zip(measurements, radii, densities, strict=True)
    ]
    waves = np.array([independent_waves(measurement) for measurement in measurements])
    data = _Data(radii, densities, waves, bands, LongWaves(measurements, densities, bands))
    count = int(data.reliable(bands).any(axis=0).sum())
    if count < FEWEST:
        listing = "; ".join(
            f"{measurement.path} {measurement.dataset}".strip() + f" {band}"
            for measurement, band in zip(measurements, bands, strict=True)
        )
        raise ValueError(
            f"expected measurements that are reliable in at least {FEWEST} bins of wavelengths "
            f"(ten a decade from 0.1 nm to 100 µm), found {count}: {listing}"
        )
    return data


def joined_spectrum(
    measurements: Sequence[Measurement], tip_radii: Sequence[float | None]
) -> xr.Dataset:
    """Return the spectrum of a surface, joined of its measurements within their reliable bands.

    Parameters
    ----------
    measurements : sequence of Measurement
        Levelled maps and line scans.
    tip_radii : sequence of float or None
        In nm, by measurement; None to use the radius that its file states, if any.

    Returns
    -------
    xarray.Dataset
        `spectrum` (wavevector) in nm⁴ over all scales; `joined` (bin_wavevector) in nm⁴, the mean
        logarithm of the reliable densities, weighted by independent waves, freed of the bias of the
        logarithm and smoothed where waves are few, NaN in other bins; `psd` and `reliable`
        (measurement, bin_wavevector), and properties of each measurement.

    Raises
    ------
    ValueError
        If fewer than three bins of wavelengths are reliable, in one line.
    """
    data = _data(measurements, tip_radii)
    reliable = data.reliable(data.bands)
    bins = _mean_bins(reliable, data.densities, data.waves)
    lines = _lines(bins)
    points = _with_power_of_bins(_points(bins, lines), bins.power)
    joined = np.where(reliable.any(axis=0), Spectrum(*points[:2])(BIN_CENTRES), np.nan)
    spectrum, tail, rolloff = _continued(points, _hurst_of_bins(bins, lines), data.long_waves)
    used_bands = [band for band, bins in zip(data.bands, reliable, strict=True) if bins.any()]
    descriptions = [
        {
            "kind": measurement.kind,
            "size": size_of(measurement),
            "pixel_size": measurement.pixel_size,
            "shortest_reliable": band.shortest,
            "longest_reliable": band.longest,
            "limited_by": band.limited_by,
            "path": measurement.path,
            "dataset": measurement.dataset,
            "tip_radius": np.nan if radius is None else radius,
            "notes": "; ".join(measurement.notes),
            **dict.fromkeys(DEFECT_UNITS, np.nan),
            **{
                name: number
                for numbers in measurement.defects.values()
                for name, number in numbers.items()
            },
        }
        for measurement, radius, band in zip(measurements, data.radii, data.bands, strict=True)
    ]
    return _with_measurements(
        spectrum_dataset(spectrum), joined, data.densities, reliable, descriptions
    ).assign_attrs(
        basis="measured",
        calibrated_to_table1="",
        shortest_measured=min(band.shortest for band in used_bands),
        longest_measured=max(band.longest for band in used_bands),
        rolloff=rolloff,
        tail_known=int(
            has_exponent(tail) and not any("edges" in scan.defects for scan in measurements)
        ),
        **tail._asdict(),
    )


def drawn_spectra(
    rngs: Iterable[np.random.Generator],
    measurements: Sequence[Measurement],
    tip_radii: Sequence[float | None],
) -> Iterator[tuple[Spectrum, Floats]]:
    """Draw spectra of a surface within the uncertainty of its measurements, one by each generator.

    Measurements and radii are the arguments of `joined_spectrum`. Random are the power of the few
    waves in each bin and the bends between them; the calibrations; the radii of tips that are not
    known, uniform in their logarithm within TIPS; the Hurst exponent of the tail; and the roll-off.
    Yields each spectrum with the factors (measurement,) by which it takes heights to be wrong.
    """
    data = _data(measurements, tip_radii)
    for rng in rngs:
        bands = [
            band
            if radius is not None or measurement.kind != "map"
            else with_tip(band, measurement, float(np.exp(rng.uniform(*np.log(TIPS)))))
            for measurement, radius, band in zip(measurements, data.radii, data.bands, strict=True)
        ]
        reliable = data.reliable(bands)
        if reliable.any(axis=0).sum() < FEWEST:
            reliable = data.reliable(data.bands)
        calibration = CALIBRATION * rng.standard_normal(len(bands))
        common = calibration.mean()
        densities = data.densities * np.exp(calibration - common)[:, None]
        bins = _mean_bins(reliable, densities, data.waves)
        lines = _lines(bins)
        points, hurst = _points(bins, lines, rng), _hurst_of_bins(bins, lines)
        change = hurst.error * rng.standard_normal()
        spectrum, *_ = _continued(points, hurst, data.long_waves, rng.uniform(), change)
        yield Spectrum(WAVEVECTORS, spectrum * np.exp(common)), np.exp(calibration / 2)


class _Bins(NamedTuple):
    """The mean of all measurements in each bin, NaN where there is none."""

    density: (
        Floats  #: (bins,) C_iso in nm⁴ of the mean of ln C, freed of the bias of the logarithm.
    )
    variance: Floats  #: (bins,) of ln C, by the number of waves alone.
    power: Floats  #: (bins,) mean C_iso in nm⁴.


def _mean_bins(reliable: NDArray[np.bool_], density: Floats, waves: Floats) -> _Bins:
    """Return the means over measurements of C_iso (measurement, bins) in nm⁴ where reliable."""
    wave_variance = variance_of_log(waves)
    weight = np.where(reliable, 1 / (wave_variance + CALIBRATION**2), 0.0)
    logs = np.where(reliable, np.log(density) + bias_of_log(waves), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = weight / weight.sum(axis=0)
    variance = (weight**2 * wave_variance).sum(axis=0)
    power = (weight * np.where(reliable, density, 0.0)).sum(axis=0)
    return _Bins(np.exp((weight * logs).sum(axis=0)), variance, power)


def _hurst_of_bins(bins: _Bins, lines: NDArray[np.bool_]) -> HurstFit:
    """Return the Hurst exponent of the bins without lines."""
    fitted = np.isfinite(bins.density) & ~lines
    return fitted_hurst(BIN_CENTRES[fitted], bins.density[fitted], bins.variance[fitted])


def _lines(bins: _Bins) -> NDArray[np.bool_]:
    """Return which bins hold a line: more power than chance adds to a smooth spectrum."""
    from scipy.special import gammaincc

    inner = np.flatnonzero(np.isfinite(bins.density))[1:-1]
    waves = 1 / bins.variance[inner] + 0.5  # The variance of ln C is the trigamma of their number.
    lines = np.zeros(len(bins.power), bool)
    while True:
        curve = Spectrum(*smoothed(np.where(lines, np.nan, bins.density), bins.variance)[:2])
        chance = gammaincc(waves, waves * bins.power[inner] / curve(BIN_CENTRES[inner]))
        found = inner[(chance < LINE) & ~lines[inner]]
        if not len(found):
            return lines
        lines[found] = True


def _points(
    bins: _Bins, lines: NDArray[np.bool_], rng: np.random.Generator | None = None
) -> tuple[Floats, Floats, Floats]:
    """Return the bins smoothed as by `smoothed`, but lines as they are."""
    points = smoothed(np.where(lines, np.nan, bins.density), bins.variance, rng)
    wavevector, density, variance = points
    place = np.isin(BIN_CENTRES, wavevector)
    return wavevector, np.where(lines[place], bins.power[place], density), variance


def _with_power_of_bins(
    points: tuple[Floats, Floats, Floats], power: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return points with the variance of heights that C_iso (bins,) in nm⁴ has in known bins.

    Of all curves with this variance theirs is the most likely one, to first order: ln C changes in
    proportion to its variance and to the share of a bin in the variance of heights.
    """
    from scipy.optimize import brentq

    wavevector, density, variance = points
    power = power[np.isin(BIN_CENTRES, wavevector)]
    total = np.nansum(power * wavevector**2)
    share = np.where(np.isfinite(power), density * wavevector**2 / total, 0.0)
    doubt = (variance - CALIBRATION**2) * share

    def excess(strength: float) -> float:
        return float((share * np.exp(strength * doubt)).sum() - 1)

    bound = MAX_LOG_CHANGE / doubt.max()
    strength = brentq(excess, -bound, bound)
    return wavevector, density * np.exp(strength * doubt), variance


def smoothed(
    joined: Floats, variance: Floats, rng: np.random.Generator | None = None
) -> tuple[Floats, Floats, Floats]:
    """Return the wavevectors from the first to the last finite bin, C_iso there, its variance.

    C_iso (bins,) in nm⁴ has the variance (bins,) of its logarithm by the number of waves. The slope
    d ln C/d ln q changes at random by KINK a root of a decade (an integrated Wiener process): the
    mean of all curves that may be, given the points, is a smoothing spline (Wahba, J. R. Stat. Soc.
    B 40 (1978) 364). A generator draws one of the curves. The returned variance covers these curves
    and the calibration.
    """
    finite = np.flatnonzero(np.isfinite(joined))
    bins = slice(finite[0], finite[-1] + 1)
    weight = np.where(np.isfinite(joined), 1 / variance, 0.0)[bins]
    count, change = len(weight), KINK * np.sqrt(BIN / np.log(10))
    bends = np.diff(np.eye(count), n=2, axis=0) / (BIN * change)
    posterior = np.linalg.inv(np.diag(weight) + bends.T @ bends)
    logs = np.log(np.where(weight > 0, joined[bins], 1.0))
    curve = np.zeros(count)
    if rng is not None:
        curve = BIN * np.cumsum(np.cumsum(change * rng.standard_normal(count)))
        noise = np.where(weight > 0, np.sqrt(variance[bins]), 0.0)
        logs = logs - curve - noise * rng.standard_normal(count)
    smooth = curve + posterior @ (weight * logs)
    return BIN_CENTRES[bins], np.exp(smooth), np.diag(posterior) + CALIBRATION**2


def _continued(
    points: tuple[Floats, Floats, Floats],
    hurst: HurstFit,
    long_waves: LongWaves,
    probability: float = 0.5,
    hurst_change: float = 0.0,
) -> tuple[Floats, Tail, float]:
    """Return a joined C_iso (nm⁴) extrapolated to WAVEVECTORS, with its tail and roll-off in nm."""
    density, tail = continued_spectrum(*points[:2], hurst, hurst_change)
    slope, longest = float(local_slopes(*points)[0][0]), float(2 * np.pi / points[0][0])
    rolloff = long_waves.rolloff(density, longest, slope, probability)
    return with_rolloff(density, longest, slope, rolloff), tail, rolloff


def _with_measurements(
    spectrum: xr.Dataset,
    joined: Floats,
    psds: Floats,
    reliable: NDArray[np.bool_],
    measurements: Sequence[Mapping[Any, Any]],
) -> xr.Dataset:
    """Return a spectrum with its measurements, as lists of their words, lengths and defects."""
    axes, axis = ("measurement", "bin_wavevector"), "bin_wavevector"
    columns = {
        name: (
            "measurement",
            [measurement[name] for measurement in measurements],
            {} if isinstance(value, str) else {"units": DEFECT_UNITS.get(name, "nm")},
        )
        for name, value in measurements[0].items()
    }
    return spectrum.assign(
        {
            "psd": (axes, psds, {"units": "nm4", "long_name": "isotropic PSD"}),
            "reliable": (axes, reliable.astype("int8"), {"long_name": "1 where it is reliable"}),
            **columns,
            "joined": (axis, joined, {"units": "nm4", "long_name": "joined PSD"}),
        }
    ).assign_coords({axis: (axis, BIN_CENTRES, {"units": "rad nm-1"})})


def described_spectrum(stored: xr.Dataset, path: str) -> xr.Dataset:
    """Return a stored substitute spectrum in the form of a joined spectrum.

    Its known bands take the place of measurements, neighbours of one source as one. Variables that
    only a measurement has are NaN or empty. The path is the file of the description.
    """
    bands = pd.read_csv(io.StringIO(stored.attrs["bands"]))
    known_bands = bands[bands.basis.isin(KNOWN)]
    previous = known_bands.shift()
    has_gap = known_bands.longest_nm != previous.shortest_nm
    begins = has_gap | (known_bands.source != previous.source)
    runs = known_bands.groupby(begins.cumsum()).agg(
        shortest_reliable=("shortest_nm", "last"),
        longest_reliable=("longest_nm", "first"),
        notes=("source", "first"),
    )
    longest = runs.longest_reliable.clip(upper=2 * np.pi / WAVEVECTORS[0])  # as in the table
    descriptions = runs.assign(
        longest_reliable=longest, kind="description", path=path, dataset="", limited_by="source"
    ).assign(**dict.fromkeys(("size", "pixel_size", "tip_radius", *DEFECT_UNITS), np.nan))
    wavelength, density = 2 * np.pi / BIN_CENTRES, spectrum_from(stored)(BIN_CENTRES)
    ends = descriptions[["shortest_reliable", "longest_reliable"]].to_numpy()
    shortest, longest = ends.T[..., None]
    reliable = (shortest < wavelength) & (wavelength <= longest)
    joined = np.where(reliable.any(axis=0), density, np.nan)
    psds = np.where(reliable, density, np.nan)
    return _with_measurements(
        stored[["spectrum"]], joined, psds, reliable, descriptions.to_dict("records")
    ).assign_attrs(
        basis="substitute",
        calibrated_to_table1=stored.attrs["calibrated_to_table1"],
        shortest_measured=descriptions.shortest_reliable.min(),
        longest_measured=descriptions.longest_reliable.max(),
        **Tail()._asdict(),
        tail_known=1,
        rolloff=np.nan,
    )


def stacked_spectra(spectra: Mapping[str, xr.Dataset], labels: Mapping[str, str]) -> xr.Dataset:
    """Return the joined spectra of all surfaces, given by surface, with their names in print.

    Variables have a leading dimension `surface`, filled with NaN, 0 or "". Variables (surface) hold
    `label` and ENDS.
    """
    numbered = [
        spectrum.drop_attrs(deep=False).assign_coords(
            measurement=range(spectrum.sizes["measurement"])
        )
        for spectrum in spectra.values()
    ]
    fill = {
        name: {"U": "", "O": "", "i": 0}.get(values.dtype.kind, np.nan)
        for name, values in numbered[0].data_vars.items()
    }
    names = pd.Index(list(spectra), name="surface")
    stacked = xr.concat(
        numbered, names, join="outer", fill_value=fill, combine_attrs="override"
    ).drop_vars("measurement")
    for name, unit in ENDS.items():
        ends = [spectrum.attrs[name] for spectrum in spectra.values()]
        stacked[name] = ("surface", ends, {"units": unit})
    return stacked.assign(label=("surface", [labels[name] for name in spectra]))
