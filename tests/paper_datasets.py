"""Datasets like the study's, small, that hold the numbers of the paper."""

import json

import numpy as np
import xarray as xr
from intervals import between_multiples
from known_forces import FORCE_DIMS
from paper_numbers import MEAN_FORCE, MEDIAN_FORCE, SUBSTRATES, SURFACES, TABLE1

from hardcontact.surfaces.height_map import table1_variables

GROUPS = [*SUBSTRATES, "pooled"]
MODELS = ["rigid", "plastic"]
RHO = [0.05, 2.0, 4.0, 5.6, 8.0]
RADIUS = 0.25e6  # nm
CALIBRATED = "afm_rms_height,afm_rms_slope,afm_rms_curvature,all_rms_slope,all_rms_curvature"
SCATTER = np.array([0.98, 0.99, 1.0, 1.01, 1.02])
CONFIDENCE = 0.95


def with_interval(name, dims, values, width=0.01):
    """A variable and its interval, `width` relative to either side."""
    return between_multiples(name, dims, values, (1 - width, 1 + width), CONFIDENCE)


def scattered(values, *shape):
    """Values that scatter over five scans, alike in `shape` contacts: (..., scan, *shape)."""
    values = np.multiply.outer(np.asarray(values, float), SCATTER)
    return np.broadcast_to(values[(...,) + (None,) * len(shape)], values.shape + shape).copy()


def make_topography(basis="substitute", surfaces=SURFACES):
    printed = {name: values for name, (values, _) in TABLE1.items()}
    metrics = {
        "rms_height": [*printed["afm_rms_height"], 0.5],
        "rms_gradient": [*printed["afm_rms_slope"], 0.01],
        "rms_half_laplacian": [*printed["afm_rms_curvature"], 1e-3],
        "peak_to_valley": [20.0, 90.0, 600.0, 650.0, 4.0],
    }
    all_scales = {
        "rms_height": [*printed["all_rms_height"], 0.5],
        "rms_gradient": [*printed["all_rms_slope"], 0.1],
        "rms_half_laplacian": [*printed["all_rms_curvature"], 1.0],
    }
    data = {}
    for name, values in metrics.items():
        scans = xr.DataArray(scattered(values), dims=("surface", "scan"))
        data |= {name: scans}
        data |= with_interval(f"{name}_mean", ["surface"], scans.mean("scan"), width=0)
    data |= {f"all_scales_{name}": ("surface", values) for name, values in all_scales.items()}
    data["psd_isotropic"] = (("surface", "scan", "wavevector"), scattered([1e3] * 5, 21))
    data["basis"] = ("surface", np.array([basis] * 5, dtype=object))
    data["calibrated_to_table1"] = ("surface", [CALIBRATED] * 4 + [""])
    names = json.dumps(table1_variables("gradient", "half_laplacian"))
    attributes = {"sphere_surface": "ruby", "table1_variables": names, "confidence": CONFIDENCE}
    coords = {"surface": SURFACES, "wavevector": np.linspace(0, 0.6, 21)}
    return xr.Dataset(data, coords, attributes).sel(surface=surfaces)


def make_adhesion(surfaces=SUBSTRATES):
    """Log-normal forces of the paper's medians that grow as rho to the power `slopes`.

    At the smallest range the force is twice that of the contact pixels.
    """
    dims = FORCE_DIMS
    slopes = xr.DataArray([0.9, 0.6, 0.3, 0.2], dims="surface")
    shape = xr.DataArray([1.8, 1.0, 1.0, 1.1], dims="surface")
    rng = np.random.default_rng(0)
    normal = xr.DataArray(rng.normal(size=(5, 2, 10, 10)), dims=dims[1:3] + dims[5:])
    model = xr.DataArray([0.5, 1.0], dims="contact_model")
    rho = xr.DataArray(RHO, dims="rho")
    scale = model * (rho / 5.6) ** slopes
    force = scale * xr.DataArray(MEDIAN_FORCE, dims="surface") * np.exp(shape * normal)
    of_pixels = 400e-18 / (RHO[0] * 1e-9)
    force = xr.where(rho == RHO[0], 1.25 * of_pixels * model * np.exp(0.01 * normal), force)
    apex = scattered([-10.0, -60.0, -300.0, -330.0], 2, 2, 10, 10)
    data = {
        "pull_off_force": force.transpose(*dims),
        "closest_approach": (dims[:4] + dims[5:], apex),
        "window_change": (("surface", "scan"), np.full((4, 5), 1e-3)),
        "finer_pixel_change": (("surface", "scan"), scattered([0.25] * 4)),
        "contact_pixels": ("contact_model", [1, 4]),
    }
    coords = {"surface": SUBSTRATES, "contact_model": MODELS, "rho": RHO}
    attributes = {"reference_rho": 5.6, "work_of_adhesion": 1.0, "pixel_size": 10.0}
    attributes |= {"sphere_radius": RADIUS, "confidence": CONFIDENCE}
    return xr.Dataset(data, coords, attributes).sel(surface=surfaces)


def make_inference(surfaces=SUBSTRATES):
    """Fits at which plastic contact is the paper's, and rigid contact ten times worse."""
    by_model, by_force = ("contact_model",), ("contact_model", "surface")
    by_pair = ("contact_model", "pair", "surface")
    ratio = MEAN_FORCE / MEAN_FORCE[1]
    shape = np.sqrt(2 * np.log(MEAN_FORCE / MEDIAN_FORCE))
    force = np.outer(MEAN_FORCE, np.array(RHO) / 5.6) / 0.0463
    of_model = np.array([0.1, 1.0])[:, None, None]
    data = {
        "ratio_error": ((*by_model, "rho_fine"), [[0.9, 0.4], [0.9, 0.05]]),
        "error_of_range": ((*by_model, "rho_fine"), [[0.8, 0.5], [0.8, 0.05]]),
        "minimum_error": ((*by_model, "minimum"), [[0.5, np.nan], [0.05, 0.3]]),
    }
    for name, ends in {"range": (5.1, 6.1), "work": (0.0428, 0.0498)}.items():
        data[f"region_{name}"] = ((*by_model, "bound"), [(np.nan, np.nan), ends])
    data |= with_interval("best_error", by_model, [0.5, 0.05])
    data |= with_interval("model_error_ratio", (), 10.0)
    data |= with_interval("range_of_adhesion", by_model, [1.0, 5.6])
    data |= with_interval("range_from_ratios", by_model, [1.0, 5.0])
    data |= with_interval("work_of_adhesion", by_model, [0.5, 0.0463])
    for name, values in (("force_mean", MEAN_FORCE), ("force_median", MEDIAN_FORCE)):
        data |= with_interval(name, by_pair, of_model * np.broadcast_to(values, (2, 2, 4)))
    for name, values in (("lognormal_shape", shape), ("ratio_at_pair", ratio)):
        data |= with_interval(name, by_pair, np.broadcast_to(values, (2, 2, 4)))
    data |= with_interval("mean_force", (*by_force, "rho"), [0.5 * force, force])
    coords = {"contact_model": MODELS, "surface": SUBSTRATES, "rho": RHO, "minimum": [1, 2]}
    coords |= {"rho_fine": [0.5, 5.6], "pair": ["published", "fitted"]}
    attributes = {"sphere_radius": RADIUS, "confidence": CONFIDENCE}
    return xr.Dataset(data, coords, attributes).sel(surface=surfaces)


def make_band(surfaces=SUBSTRATES):
    """A band within the published one, of every surface and of all pooled."""
    ratio = [
        [1.0, 1.05, 2.0, 4.0, np.nan, np.nan],
        [np.nan, np.nan, 0.4, 0.7, 0.95, 1.0],
    ]
    by_group = ("side", "group", "cutoff_wavelength")
    by_surface = ("side", "surface", "cutoff_wavelength")
    data = with_interval("scale_ratio", by_surface, np.stack([ratio] * 4, axis=1))
    change = np.abs(np.stack([ratio] * 5, axis=1) - 1)
    data |= with_interval("scale_change", by_group, change, width=0.1)
    critical = np.repeat([[46.0], [1750.0]], 5, axis=1)
    data |= with_interval("critical_wavelength", ("side", "group"), critical)
    coords = {"side": ["small", "large"], "group": GROUPS, "surface": SUBSTRATES}
    coords["cutoff_wavelength"] = [10.0, 43.0, 200.0, 1000.0, 1800.0, 5000.0]
    attributes = {"scale_tolerance": 0.1, "sphere_radius": RADIUS, "confidence": CONFIDENCE}
    dataset = xr.Dataset(data, coords, attributes)
    return dataset.sel(surface=surfaces, group=[*surfaces, "pooled"])


def make_scales(surfaces=SUBSTRATES):
    dims = ("surface", "realization", "side", "cutoff_wavelength", "contact_y", "contact_x")
    force = np.full((4, 3, 2, 3, 2, 2), 1.0e-3)
    force[:, :, 0, 2] = np.nan
    coords = {"surface": SUBSTRATES, "side": ["small", "large"]}
    coords["cutoff_wavelength"] = [10.0, 1000.0, 5000.0]
    attributes = {"sphere_radius": RADIUS, "confidence": CONFIDENCE}
    return xr.Dataset({"pull_off_force": (dims, force)}, coords, attributes).sel(surface=surfaces)


def make_elastic(surfaces=SUBSTRATES):
    """Two contacts a scan; elastic forces 1 % below the rigid ones, small areas of contact."""
    rigid = scattered([1e-6, 0.3e-6, 0.1e-6, 0.1e-6], 2)
    values = {
        "contact_area": scattered([300.0, 250.0, 200.0, 200.0], 2),
        "hard_share": scattered([0.6, 0.7, 0.8, 0.8], 2),
        "peak_pressure": scattered([60e9, 70e9, 80e9, 80e9], 2),
        "rigid_pull_off_force": rigid,
        "elastic_pull_off_force": 0.99 * rigid,
    }
    data = {name: (("surface", "scan", "contact"), array) for name, array in values.items()}
    attributes = {"hardness": 25e9, "preload": 10e-6, "effective_modulus": 289.7e9}
    attributes |= {"work_of_adhesion": 0.0463, "confidence": CONFIDENCE}
    return xr.Dataset(data, {"surface": SUBSTRATES}, attributes).sel(surface=surfaces)


def make_indent(surface="ncd"):
    """Indents of the paper's size at 20 µN, of half of it at 10 µN."""
    dims = ("preload", "scan", "sphere_scan", "contact_y", "contact_x")
    sizes = {"depth": 2.0, "edge_length": 50.0, "lateral_size": 80.0}
    data = {name: (dims, scattered([value / 2, value], 2, 3, 3)) for name, value in sizes.items()}
    preloads = [1e-5, np.nextafter(2e-5, 1)]
    return xr.Dataset(data, {"preload": preloads}, {"surface": surface, "confidence": CONFIDENCE})


def make_elastic_limit(surfaces=SUBSTRATES):
    """Return pressures of all waves above the hardness, those of long waves below."""
    dims, wavelengths = ("surface", "shortest_wavelength"), [0.1, 1e6]
    data = {"slope_index": (dims, [[2.0, 0.0]] * len(surfaces))}
    return xr.Dataset(data, {"surface": surfaces, "shortest_wavelength": wavelengths})


def make_repeated_contact(surface="ncd"):
    """Return indents of which as good as none overlap."""
    data = {"indented_area_ratio": 0.999, "indented_area_ratio_interval": ("bound", [0.99, 1.01])}
    attributes = {"surface": surface, "confidence": CONFIDENCE}
    return xr.Dataset(data, {"bound": ["low", "high"]}, attributes)


def make_asperities(surfaces=SUBSTRATES):
    dims = ("surface", "rho", "scan", "contact")
    patches = [[9, 9, 9], [9, 6, 4], [2, 2, 2], [2, 2, 2]]
    share = [[0.1, 0.1, 0.1], [0.3, 0.3, 0.3], [0.7, 0.7, 0.7], [0.8, 0.8, 0.8]]
    data = {
        name: (dims, scattered(values, 4))
        for name, values in (("patches", patches), ("two_largest_share", share))
    }
    coords = {"surface": SUBSTRATES, "rho": [1.0, 5.6, 10.0]}
    return xr.Dataset(data, coords, {"confidence": CONFIDENCE}).sel(surface=surfaces)


def make_classical(surfaces=SUBSTRATES):
    work = np.array([7.15e-3, 0.32e-3, 0.13e-3, 0.08e-3])
    models = ["rumpf_height", "rumpf_curvature", "rabinovich", "fuller_tabor", "maugis"]
    laws = [[0.4, 0.3, 0.7], [0.5, 0.9, 0.7]]
    coords = {
        "metrics": ["afm", "all_scales"],
        "model": models,
        "against": ["published", "computed"],
        "rms_parameter": ["height", "slope", "curvature"],
        "tabor": ["printed", "computed", "self_consistent"],
        "surface": SUBSTRATES,
    }
    error = np.full((2, 5, 2), 0.6)
    data = {"hertz_peak_pressure": ((), 135e6), "tabor_parameter": ((), 0.81)}
    data |= with_interval("mean_relative_error", ("metrics", "model", "against"), error, 0.1)
    by_law = ("metrics", "rms_parameter", "against")
    data |= with_interval("power_law_error", by_law, np.stack([laws, laws], axis=-1), 0.1)
    by_force = ("against", "tabor", "surface")
    effective = np.broadcast_to(work, (2, 3, 4))
    data |= with_interval("effective_work_of_adhesion", by_force, effective)
    return xr.Dataset(data, coords, {"confidence": CONFIDENCE}).sel(surface=surfaces)


def make_laws(surfaces=SUBSTRATES):
    """Laws that give the forces of Eq. 1 to within 5 %, but miss the measured ones."""
    names = ["exponential", "van_der_waals", "retarded", "electrostatic"]
    coords = {"law": names, "case": ["equivalent", "fitted", "atomic"], "surface": surfaces}
    data = with_interval("fit_error", ("law", "case"), np.tile([0.05, 0.3, 0.5], (4, 1)))
    return xr.Dataset(data, coords, {"confidence": CONFIDENCE})


def make_scaling(surfaces=SUBSTRATES):
    """Long edges that follow √R."""
    over = ("side", "surface", "length")
    data = with_interval("exponent", over, np.ones((2, len(surfaces), 1)))
    coords = {"side": ["small", "large"], "surface": surfaces, "length": ["radius"]}
    return xr.Dataset(data, coords, {"confidence": CONFIDENCE})


def make_datasets(basis="substitute", surfaces=SUBSTRATES):
    return {
        "topography": make_topography(basis, [*surfaces, "ruby"]),
        "adhesion": make_adhesion(surfaces),
        "inference": make_inference(surfaces),
        "scales": make_scales(surfaces),
        "band": make_band(surfaces),
        "elastic": make_elastic(surfaces),
        "indent": make_indent("ncd" if "ncd" in surfaces else surfaces[0]),
        "repeated_contact": make_repeated_contact("ncd" if "ncd" in surfaces else surfaces[0]),
        "asperities": make_asperities(surfaces),
        "classical": make_classical(surfaces),
        "elastic_limit": make_elastic_limit(surfaces),
        "laws": make_laws(surfaces),
        "scaling": make_scaling(surfaces),
    }
