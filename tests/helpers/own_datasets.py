"""Small datasets of your surfaces, as in a study: edges, forces, fits, spectra, maps."""

from functools import cache
from typing import NamedTuple

import numpy as np
import xarray as xr
from intervals import between_multiples

from hardcontact.base.statistics import as_variables
from hardcontact.report.own_surfaces.datasets import Datasets
from hardcontact.scans.defects import DEFECT_UNITS
from hardcontact.surfaces.spectrum import BIN_EDGES, WAVEVECTORS

CONFIDENCE = 0.95
SURFACES, LABELS = ["my_coating", "twin"], ["my coating", "twin"]
MODELS = ["rigid", "plastic"]
SIDES = ["short", "long"]
RHOS = np.array([1.0, 2.0, 5.6, 10.0, 14.0])
RANGE, WORK = 5.6, 0.0463
#: Force (N) of plastic contacts on the first surface, at RANGE and WORK.
FORCE = 0.64e-6
CUTOFFS = {
    "short": np.array([5.0, 10, 20, 40, 80, 160, 320]),
    "long": np.array([160.0, 320, 640, 1280, 2560]),
}
EDGES = {"short": 37.0, "long": 1700.0}
QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]
SCANS, PIXELS, PIXEL_SIZE = 3, 64, 10.0
SIZE = PIXELS * PIXEL_SIZE


def power_law(wavevector):
    """Return C_iso (nm⁴) of a self-affine surface, H = 0.8, that rolls off at 2 µm."""
    rolled = np.maximum(wavevector, 2 * np.pi / 2000)
    return 1e-3 * rolled**-3.6


def topography(count=1, source="measured"):
    """Return the roughness of surfaces with SCANS scans each."""
    rng = np.random.default_rng(1)
    surfaces = SURFACES[:count]
    data = xr.Dataset(coords={"surface": surfaces, "scan": np.arange(1, SCANS + 1)})
    values = {
        "rms_height": 4.0, "rms_gradient": 0.31, "rms_half_laplacian": 0.021,
        "skewness": -0.2, "kurtosis": 3.1, "peak_to_valley": 27.0,
    }  # fmt: skip
    factors = 1 + 0.1 * rng.normal(size=(count, SCANS))
    for name, value in values.items():
        data[name] = ("surface", "scan"), value * factors
        mean = data[name].mean("scan").values
        data = data.assign(between_multiples(f"{name}_mean", "surface", mean, (0.9, 1.1)))
    for name, value in {"height": 6.2, "gradient": 0.74, "half_laplacian": 0.55}.items():
        data[f"all_scales_rms_{name}"] = "surface", np.full(count, value)
    maps = rng.normal(0, 4, (count, PIXELS, PIXELS))
    data["example_heights"] = ("surface", "row", "column"), maps
    data["scan_size"] = "surface", np.full(count, SIZE)
    data["pixel_size"] = "surface", np.full(count, PIXEL_SIZE)
    data["label"] = "surface", LABELS[:count]
    data["source"] = "surface", [source] * count
    return data.assign_attrs(confidence=CONFIDENCE)


class Measurement(NamedTuple):
    """A scan and its reliable wavelengths, with lengths in nm."""

    kind: str
    size: float
    pixel_size: float
    shortest_reliable: float
    longest_reliable: float
    limited_by: str
    tip_radius: float


MEASUREMENTS = {
    "fine.spm": Measurement("map", 640, 10, 55, 320, "tip", 10),
    "coarse.spm": Measurement("map", 10_000, 40, 160, 5000, "noise", np.nan),
    "line.txt": Measurement("line scan", 50_000, 200, 800, 25_000, "pixels", np.nan),
}


def spectra(count=1, scans=MEASUREMENTS):
    """Return joined spectra; a second surface has one measurement less than the first."""
    bins = np.sqrt(BIN_EDGES[1:] * BIN_EDGES[:-1])
    surface_spectra = []
    for index in range(count):
        names = list(scans)[: len(scans) - (index > 0)]
        surface_spectra.append(_surface_spectra(bins, {name: scans[name] for name in names}))
    # Where a surface has fewer measurements, numbers are padded by NaN and texts by "".
    padding = {
        name: "" if values.dtype.kind == "U" else np.nan
        for name, values in surface_spectra[0].data_vars.items()
    }
    table = xr.concat(surface_spectra, "surface", join="outer", fill_value=padding)
    return table.assign_coords(surface=SURFACES[:count]).assign(label=("surface", LABELS[:count]))


def _surface_spectra(bins, scans):
    """Return the spectra of measurements by name, with noise floors below their reliable waves."""
    rng = np.random.default_rng(1)
    wavelength = 2 * np.pi / bins
    columns = {
        name: [getattr(scan, name) for scan in scans.values()] for name in Measurement._fields
    }
    psd, reliable = [], []
    for scan in scans.values():
        short, long = scan.shortest_reliable, scan.longest_reliable
        is_resolved = (wavelength > 2 * scan.pixel_size) & (wavelength < scan.size)
        noisy = power_law(bins) * np.exp(0.15 * rng.normal(size=bins.size)) + power_law(
            2 * np.pi / short
        ) * (wavelength < short)
        psd.append(np.where(is_resolved, noisy, np.nan))
        reliable.append((is_resolved & (wavelength >= short) & (wavelength <= long)).astype("int8"))
    reliable_psd = np.where(reliable, psd, np.nan)
    logarithm = np.log(reliable_psd)
    count = np.isfinite(logarithm).sum(axis=0)
    joined_density = np.exp(np.nansum(logarithm, axis=0) / np.where(count, count, np.nan))
    texts = {name: [str(value) for value in columns.pop(name)]
             for name in ("kind", "limited_by")}  # fmt: skip
    return xr.Dataset(
        {
            "spectrum": ("wavevector", np.where(WAVEVECTORS < 2 * np.pi / 0.3,
                                                power_law(WAVEVECTORS), 0)),
            "psd": (("measurement", "bin_wavevector"), psd),
            "reliable": (("measurement", "bin_wavevector"), reliable),
            "joined_psd": ("bin_wavevector", joined_density),
            **{name: ("measurement", np.array(values, float)) for name, values in columns.items()},
            **{name: ("measurement", values) for name, values in texts.items()},
            **{name: ("measurement", np.full(len(scans), np.nan)) for name in DEFECT_UNITS},
            "path": ("measurement", [f"scans/{name}" for name in scans]),
            "dataset": ("measurement", [""] * len(scans)),
            "notes": ("measurement", ["37 undefined pixels"] + [""] * (len(scans) - 1)),
            "earlier_scan": ("measurement", [""] * len(scans)),
            "shortest_measured": min(columns["shortest_reliable"]),
            "longest_measured": max(columns["longest_reliable"]),
            "rolloff": 1.5 * max(columns["longest_reliable"]),
            "tail_hurst": 0.8,
            "tail_hurst_error": 0.1,
            "tail_known": 1,
            "tail_fit_shortest": min(columns["shortest_reliable"]),
            "tail_fit_longest": 10 * min(columns["shortest_reliable"]),
            "tail_ended_by": "atoms",
        },
        {"measurement": np.arange(1, len(scans) + 1), "wavevector": WAVEVECTORS,
         "bin_wavevector": bins},
    )  # fmt: skip


def edges(count=1):
    """Return the edges of the band, all found, with intervals of three scans."""
    surfaces = SURFACES[:count]
    cutoffs = np.unique(np.concatenate(list(CUTOFFS.values())))
    ratio = np.full((count, 2, cutoffs.size), np.nan)
    for index, side in enumerate(SIDES):
        is_computed = np.isin(cutoffs, CUTOFFS[side])
        # The change is a tenth at the edge and in proportion to the cutoff, or its inverse.
        cutoff_over_edge = cutoffs[is_computed] / EDGES[side]
        change = 0.1 * (cutoff_over_edge if side == "short" else 1 / cutoff_over_edge)
        ratio[:, index, is_computed] = 1 + change
    edge = np.tile([EDGES[side] for side in SIDES], (count, 1))
    data = xr.Dataset(
        between_multiples("filtered_force_ratio", ("surface", "side", "cutoff_wavelength"), ratio,
                          (0.95, 1.05))
        | between_multiples("edge", ("surface", "side"), edge, (0.8, 1.25), units="nm"),
        {"surface": surfaces, "side": SIDES, "cutoff_wavelength": cutoffs},
    )  # fmt: skip
    return data.assign(
        edge_bound=(("surface", "side"), np.full((count, 2), np.nan)),
        edge_status=(("surface", "side"), [["found"] * 2] * count),
        interval_source=("surface", ["scans"] * count),
        label=("surface", LABELS[:count]),
    ).assign_attrs(tolerance=0.1, confidence=CONFIDENCE)


def move_edge(edge, low, high):
    """Return edges with another short edge; the change is as the fourth power of the cutoff."""
    data, short = edges(), {"side": "short"}
    data["edge"].loc[short] = edge
    data["edge_interval"].loc[short] = [low, high]
    ratio = 1 + 0.1 * (data["cutoff_wavelength"] / edge) ** 4
    is_computed = data["filtered_force_ratio"].sel(short).notnull()
    data["filtered_force_ratio"].loc[short] = ratio.where(is_computed)
    return data


def unresolved_edges():
    """Return edges without values, because the force changes at no cutoff."""
    data = edges()
    data["filtered_force_ratio"] = data["filtered_force_ratio"] * 0 + 1.01
    data["edge"] *= np.nan
    data["edge_interval"] *= np.nan
    return data.assign(
        edge_bound=(("surface", "side"), [[CUTOFFS["short"][-1], CUTOFFS["long"][0]]]),
        edge_status=(("surface", "side"), [["open_above", "open_below"]]),
    )


def open_edges():
    """Return edges whose long edge is open above, with intervals from parts of one scan."""
    data = edges()
    long_side = {"side": "long"}
    data["edge"].loc[long_side] = np.nan
    data["edge_interval"].loc[long_side] = np.nan
    data["edge_bound"].loc[long_side] = CUTOFFS["long"][-1]
    data = data.assign(edge_status=data["edge_status"].where(data["side"] != "long", "open_above"))
    ratio = data["filtered_force_ratio"].sel(side="long")
    data["filtered_force_ratio"].loc[long_side] = ratio.where(ratio.isnull(), 1.2)
    return data.assign(interval_source=("surface", ["quarters"]))


def force(count=1):
    """Return forces: on the first surface FORCE for plastic contact at RANGE, twice for rigid."""
    surfaces = SURFACES[:count]
    mean = FORCE * (RHOS / RANGE) ** -0.5 * np.array([2.0, 1.0])[:, None]
    mean = mean * np.arange(1, count + 1)[:, None, None]
    axes = ("surface", "contact_model", "rho")
    quantiles_over_mean = np.array([0.4, 0.7, 0.95, 1.25, 1.8])
    data = xr.Dataset(
        between_multiples("force", axes, mean, (0.8, 1.25), units="N"),
        {"surface": surfaces, "contact_model": MODELS, "rho": RHOS, "quantile": QUANTILES},
    )
    data["force_quantile"] = (*axes, "quantile"), mean[..., None] * quantiles_over_mean
    data["label"] = "surface", LABELS[:count]
    data["interval_source"] = "surface", ["scans"] * count
    data["interval_scans"] = "surface", [SCANS] * count
    data = data.merge(extrapolated_force(count))
    data["correlation_of_parts"] = "surface", [0.0] * count
    data["search_size"] = "surface", np.full(count, SIZE / 2)
    data["finite_scan_ratio"] = ("surface", "end"), np.ones((count, 2))
    data["window_share"] = "rho", np.ones(RHOS.size)
    data["pixel_area"] = "surface", np.full(count, PIXEL_SIZE**2)
    data["log_force_std"] = axes, np.full(mean.shape, 0.4)
    data["contacts_needed"] = axes, np.full(mean.shape, 80.0)
    data["weibull_modulus"] = "surface", np.full(count, 0.5)
    smooth = np.full((len(MODELS), RHOS.size), 2 * np.pi * 250e-6 * WORK)
    data["smooth_bound"] = axes[1:], smooth
    return data.assign_attrs(
        work_of_adhesion=WORK, rho=RANGE, confidence=CONFIDENCE, window=12.5e3,
        contact_area=400.0, sphere_radius=250e3, tabor_parameter=0.02, bodies="hard",
    )  # fmt: skip


def extrapolated_force(count=1):
    """Return forces with extrapolated roughness, which changes no force."""
    forces = np.tile(FORCE * np.arange(1, count + 1)[:, None], 2)
    axes = ("surface", "side")
    data = xr.Dataset(
        between_multiples("extrapolated_force", axes, forces, (0.8, 1.25), units="N"),
        {"surface": SURFACES[:count], "side": SIDES},
    )
    return data.assign(
        extrapolated_force_interval_source=(axes, [["scans"] * 2] * count),
        extrapolation_end=(axes, [[5.0, 2560.0]] * count),
        extrapolation_matters=(axes, [[0, 0]] * count),
        transition=("side", [20.0, 1000.0]),
    )


def scaled_extrapolated_force(**factors):
    """Return forces that extrapolated roughness changes by a factor, by side."""
    scaled = force()
    for side, factor in factors.items():
        for name in ("extrapolated_force", "extrapolated_force_interval"):
            scaled[name].loc[{"side": side}] *= factor
        scaled["extrapolation_matters"].loc[{"side": side}] = 1
    return scaled


def drop_interval(force_data):
    """Return forces without an interval: one scan that is too small to be cut."""
    return force_data.assign(
        force_interval=force_data["force_interval"] * np.nan,
        interval_source=("surface", ["none"] * force_data.sizes["surface"]),
    )


def fit(count=1):
    """Return the fit to forces measured on a number of surfaces: W(RANGE) = WORK on each."""
    surfaces = SURFACES[:count]
    rho = np.union1d(np.geomspace(RHOS[0], RHOS[-1], 41), RHOS)
    exponents = np.array([0.5, 0.9])[:count]
    work = WORK * (rho / RANGE) ** exponents[:, None] * np.array([0.5, 1.0])[:, None, None]
    data = xr.Dataset(
        between_multiples("work_by_range", ("contact_model", "surface", "rho_fine"), work,
                          (0.8, 1.25), units="J m-2")
        | between_multiples("measured_force", "surface", [0.64e-6, 1.3e-6][:count], (0.9, 1.1),
                            units="N"),
        {"contact_model": MODELS, "surface": surfaces, "rho_fine": rho},
    )  # fmt: skip
    interval = data["work_by_range_interval"]
    low, high = interval.max("surface").sel(end="low"), interval.min("surface").sel(end="high")
    region = xr.concat([low, high], "end").transpose("contact_model", "rho_fine", "end")
    # One force does not determine both range and work.
    best = np.full(2, np.nan if count == 1 else 1.0)
    models = "contact_model"
    data = data.assign(
        region=region.where(low < high), range_of_adhesion=(models, RANGE * best),
        work_of_adhesion=(models, WORK * best * [0.5, 1], {"units": "J m-2"}),
        best_error=(models, 0.05 * best), exact_pairs=(models, [0, 0]),
        region_range=((models, "end"), [[3.2, np.nan]] * 2),
        region_work=((models, "end"), np.full((2, 2), np.nan)),
        force_count=("surface", [40] * count), site_count=("surface", [40] * count),
        look_repeated=("surface", [0] * count), label=("surface", LABELS[:count]),
        interval_source=("surface", ["scans"] * count),
    )  # fmt: skip
    return data.assign(extrapolated_work(count)).assign_attrs(confidence=CONFIDENCE, rho=RANGE)


def extrapolated_work(count):
    """Return works of adhesion with extrapolated roughness, half of WORK on each surface."""
    axes = ("surface", "side")
    work = between_multiples(
        "extrapolated_work", axes, np.full((count, 2), WORK / 2), (0.8, 1.25),
        units="J m-2",
    )  # fmt: skip
    matters = {"extrapolation_matters": (axes, [[0, 0]] * count)}
    return work | matters | {"transition": ("side", [20.0, 1000.0]), "side": SIDES}


OCTAVES = [20.0, 40.0, 80.0, 160.0, 320.0]
#: Derivatives of the force by the amplitude of each octave; no scan shows the first one.
SENSITIVITIES = [-2.0, -0.2, -0.9, -0.4, np.nan]


def sensitivity(count=1):
    """Return how the force follows each octave, with intervals."""
    values = np.tile(SENSITIVITIES, (count, 1))
    interval = np.stack([values - 0.5, values + 0.5], axis=-1)
    data = as_variables(
        "octave_sensitivity", ("surface", "octave"), values, interval, {}, CONFIDENCE
    )
    return xr.Dataset(data, {"surface": SURFACES[:count], "octave": OCTAVES})


@cache
def unchanged_datasets(count):
    """Return all datasets of a number of surfaces, without a fit; not to be changed."""
    return Datasets(
        topography(count), spectra(count), edges(count), force(count), sensitivity(count), None
    )


def datasets(count=1, **others):
    """Return all datasets of a number of surfaces, without a fit; `others` replace datasets."""
    return unchanged_datasets(count)._replace(**others)
