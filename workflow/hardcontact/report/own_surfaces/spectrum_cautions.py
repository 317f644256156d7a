"""Cautions on the scans of a surface, and on the spectrum that is made from them."""

from statistics import NormalDist

import numpy as np
import xarray as xr

from hardcontact.base.number import Number, numbers_by_name
from hardcontact.report.own_surfaces.datasets import (
    Datasets,
    drop_padding,
    measurement_name,
    split_measurements,
)
from hardcontact.report.quantities import number_of, number_without_value
from hardcontact.scans.defects import DEFECTS, defect_sentence
from hardcontact.scans.heights import split_notes
from hardcontact.scans.reliable_band import OTHER_BODY
from hardcontact.scans.scan_pairs import find_contradictions

#: Pixels in the shortest wavelength that a scan resolves, by the sampling theorem.
NYQUIST_PIXELS = 2
#: Largest ratio of added power to the power in the scans without a caution. The choice of 2 lets
#: amplitudes differ by up to 1.4.
MAX_POWER_RATIO = 2.0
#: Codes of defects that change the highest points, and thus the force.
MISLEADING_DEFECTS = frozenset({"spikes", "equal_lines", "highest"})


class Caution:
    """A caution about the answer of one surface: a code, and what its sentence needs.

    A grave caution changes the force by more than the tolerance of the band. `measurement` is the
    number of the measurement with a defect, 0 for other cautions. `texts` are names of scans and
    the like, by their role in the sentence.
    """

    def __init__(
        self, code: str, *numbers: Number, grave: bool = False, measurement: int = 0, **texts: str
    ) -> None:
        self.code = code
        self.numbers = numbers_by_name(*numbers)
        self.grave = grave
        self.measurement = measurement
        self.texts = texts


def blind_scans_caution(data: Datasets) -> Caution | None:
    """Return a caution if the maps on which contacts are made are reliable nowhere."""
    scans = drop_padding(data.spectra)
    makes_contacts = (scans["kind"].values.astype(str) == "map") & np.isclose(
        scans["pixel_size"].values ** 2, data.force["pixel_area"].item()
    )
    is_reliable = (scans["reliable"].values == 1).any(axis=1)
    makes_contacts &= scans["limited_by"].values.astype(str) != OTHER_BODY
    is_blind = makes_contacts.any() and not is_reliable[makes_contacts].any()
    return Caution("blind_scans", grave=True) if is_blind else None


def defect_cautions(spectra: xr.Dataset, *, grave: bool) -> list[Caution]:
    """Return a caution for each defect of the measurements, grave for MISLEADING_DEFECTS."""
    defects = []
    for index, measurement in enumerate(split_measurements(spectra), start=1):
        for code, units in DEFECTS.items():
            values = {name: measurement[name].item() for name in units}
            if (code in MISLEADING_DEFECTS) != grave or not np.isfinite([*values.values()]).all():
                continue
            numbers = [Number(name, values[name], units[name], source="file") for name in units]
            texts = {
                "scan": measurement_name(measurement),
                "sentence": defect_sentence(code, values),
            }
            defects.append(Caution(code, *numbers, grave=grave, measurement=index, **texts))
    return defects


def reading_cautions(spectra: xr.Dataset) -> list[Caution]:
    """Return the cautions that reading the file of each measurement gave, as sentences."""
    return [
        Caution("reading", scan=measurement_name(measurement), sentence=line)
        for measurement in split_measurements(spectra)
        for line in split_notes(str(measurement["notes"].item()).splitlines())[1]
    ]


def repeated_scan_cautions(spectra: xr.Dataset) -> list[Caution]:
    """Return a caution for each scan of an area that an earlier scan shows."""
    return [
        Caution("repeated_scan", grave=True, scan=measurement_name(scan), earlier=earlier)
        for scan in split_measurements(spectra)
        if (earlier := str(scan["earlier_scan"].item()))
    ]


def contradiction_caution(spectra: xr.Dataset) -> Caution | None:
    """Return a caution about the two measurements that contradict each other most, if any do."""
    scans = drop_padding(spectra)
    arrays = [scans[name].values for name in ("psd", "reliable", "kind", "size")]
    contradictions = find_contradictions(*arrays)
    if not contradictions:
        return None
    worst = contradictions[0]
    names = [measurement_name(scan) for scan in split_measurements(scans)]
    return Caution(
        "contradiction",
        number_without_value("band", *worst.wavelengths, "nm"),
        Number("factor", worst.factor),
        Number("more_pairs", len(contradictions) - 1),
        higher=names[worst.higher],
        lower=names[worst.lower],
    )


def excess_roughness_caution(spectra: xr.Dataset) -> Caution | None:
    """Return a caution if the added roughness exceeds that in the scans, which may be smoothed."""
    q = spectra["bin_wavevector"].values
    wavelength = 2 * np.pi / q
    scans = drop_padding(spectra)
    is_resolved = wavelength >= NYQUIST_PIXELS * scans["pixel_size"].values[:, None]
    densities = np.where(is_resolved & np.isfinite(scans["psd"].values), scans["psd"].values, 0.0)
    scan_density = densities.max(axis=0, initial=0.0)
    added_density = np.interp(q, spectra["wavevector"].values, spectra["spectrum"].values)
    is_added = wavelength < spectra["shortest_measured"].item()
    is_excess = is_added & (scan_density > 0) & (added_density > MAX_POWER_RATIO * scan_density)
    if not is_excess.any():
        return None
    shortest, longest = wavelength[is_excess].min(), wavelength[is_excess].max()
    factor = (added_density[is_excess] / scan_density[is_excess]).max()
    band = number_without_value("band", float(shortest), float(longest), "nm")
    return Caution("more_than_measured", band, Number("factor", float(factor)))


def tail_caution(data: Datasets) -> Caution:
    """Return the caution on the extrapolation of the spectrum to short wavelengths."""
    spectra = data.spectra
    wavelength = 2 * np.pi / spectra["wavevector"].values[spectra["spectrum"].values > 0]
    quantile = NormalDist().inv_cdf((1 + data.edges.attrs["confidence"]) / 2)
    hurst = spectra["tail_hurst"].item()
    half_width = quantile * spectra["tail_hurst_error"].item()
    low, high = max(hurst - half_width, 0.0), min(hurst + half_width, 1.0)
    shortest, longest = spectra["tail_fit_shortest"].item(), spectra["tail_fit_longest"].item()
    return Caution(
        "tail",
        Number("hurst", hurst, "1", low, high, source="extrapolated"),
        Number("exponent_known", int(spectra["tail_known"].item() == 1)),
        number_without_value("fitted_band", shortest, longest, "nm"),
        Number("spectrum_end", float(wavelength.min()), "nm"),
        ended_by=spectra["tail_ended_by"].item(),
    )


def long_wave_caution(data: Datasets) -> Caution | None:
    """Return a caution on the extrapolation of the spectrum to long wavelengths, if any."""
    rolloff = data.spectra["rolloff"].item()
    if not np.isfinite(rolloff):
        return None
    numbers = [
        Number("rolloff", rolloff, "nm", source="extrapolated"),
        number_of(data.spectra, "longest_measured", "nm"),
    ]
    if "sphere_share" not in data.spectra:  # Otherwise the spectrum is of both bodies.
        numbers += [
            Number("scan_rms_height", float(data.topography["rms_height"].mean()), "nm"),
            number_of(data.topography, "all_scales_rms_height", "nm"),
        ]
    return Caution("long_waves", *numbers)
