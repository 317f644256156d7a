"""Height maps: reading scans, levelling, subtracting the sphere, mirror stitching, rms metrics.

A height map is an array (y, x) in nm on square pixels; heights grow out of the material.
"""

import io
import warnings
import zipfile
from pathlib import Path

import numpy as np
import yaml
from scipy.stats import kurtosis, skew
from scipy.stats import t as student_t
from SurfaceTopography import Topography, open_topography
from SurfaceTopography.Exceptions import CannotDetectFileFormat, MetadataAlreadyFixedByFile
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

__all__ = [
    "METRICS",
    "averages",
    "level",
    "metrics",
    "mirror_stitch",
    "read_scan",
    "subtract_sphere",
    "table1_variables",
    "thinned",
]

#: Metrics of a height map with their units and long names, in the order of Table 1.
METRICS = {
    "rms_height": ("nm", "rms height"),
    "rms_gradient": ("1", "rms gradient (2D slope)"),
    "rms_profile_slope": ("1", "rms slope of profiles along x"),
    "rms_half_laplacian": ("nm-1", "half the rms Laplacian (mean curvature)"),
    "rms_laplacian": ("nm-1", "rms Laplacian"),
    "skewness": ("1", "skewness of heights"),
    "kurtosis": ("1", "kurtosis of heights (3 for a Gaussian)"),
    "peak_to_valley": ("nm", "peak to valley"),
}

#: What slope and curvature of Table 1 may be.
DEFINITIONS = {
    "gradient": "rms_gradient",
    "profile": "rms_profile_slope",
    "half_laplacian": "rms_half_laplacian",
    "laplacian": "rms_laplacian",
}

#: The largest member of a container that is read, in bytes.
MEMBER_LIMIT = 2**30


def read_scan(path, dataset="", undefined_pixels="refuse"):
    """Heights (y, x) in nm and the pixel size in nm of a measured scan.

    path: any format SurfaceTopography reads, or a contact.engineering container (.zip), of which
    `dataset` names one member by its name or data file; undefined_pixels: "refuse", or the name
    of an interpolation of SurfaceTopography ("harmonic") that fills them.

    Raises ValueError, in one line, if the scan is missing, unreadable, without physical size or
    unit, not square, on pixels that are not square, or has undefined pixels that may not be filled.
    """
    try:
        topography = _open(Path(path), dataset)
    except _Refused as error:
        raise ValueError(f"{path}: {error}") from None
    except CannotDetectFileFormat:
        raise ValueError(
            f"{path}: expected a whole file in a format that SurfaceTopography reads, "
            "found one that none of its readers takes"
        ) from None
    except Exception as error:  # a reader meets damaged bytes in any way it likes
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise ValueError(f"{path}: expected a readable scan, found: {reason}") from None
    return _checked(topography, path, undefined_pixels)


class _Refused(Exception):
    """A scan that can be opened but not used."""


def _open(path, dataset):
    if not path.is_file():
        raise _Refused("expected a scan, found no such file")
    if path.stat().st_size == 0:
        raise _Refused("expected a scan, found an empty file")
    if zipfile.is_zipfile(path) and "meta.yml" in (names := zipfile.ZipFile(path).namelist()):
        return _open_member(path, dataset, names)
    if dataset:
        raise _Refused(f"expected a whole container with a dataset {dataset!r}, found none")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return _topography(open_topography(str(path)), {})


def _topography(reader, stated):
    """The height map of a reader; stated: what is known beside the file."""
    if reader.default_channel.physical_sizes is None and "physical_sizes" not in stated:
        raise _Refused("expected a file that states the physical size of the scan, found none")
    return reader.topography(**stated)


class _MetaLoader(yaml.SafeLoader):
    """Plain data only; the containers' tuples are read as lists, nothing is executed."""


_MetaLoader.add_constructor("tag:yaml.org,2002:python/tuple", yaml.SafeLoader.construct_yaml_seq)


def _open_member(path, dataset, names):
    """The named scan of a contact.engineering container, read in memory."""
    with zipfile.ZipFile(path) as container:
        meta = yaml.load(container.read("meta.yml"), Loader=_MetaLoader)
        entry = _entry_of(meta, dataset)
        member = entry["datafile"]["original"]
        if member not in names or container.getinfo(member).file_size > MEMBER_LIMIT:
            raise _Refused(f"expected the data file {member} of at most {MEMBER_LIMIT} bytes")
        reader = open_topography(io.BytesIO(container.read(member)))
    # What the container says holds only where the data file itself is silent: applying its
    # height scale to a calibrated file would calibrate it twice.
    kept = {}
    for key, value in (
        ("physical_sizes", tuple(entry.get("size") or ()) or None),
        ("unit", entry.get("unit")),
        ("height_scale_factor", entry.get("height_scale")),
    ):
        try:
            if value is not None:
                _topography(reader, kept | {key: value})
                kept[key] = value
        except MetadataAlreadyFixedByFile:
            pass
    return _topography(reader, kept)


def _entry_of(meta, dataset):
    """What a container's meta.yml says of the one scan of this name or data file."""
    entries = [entry for surface in meta["surfaces"] for entry in surface["topographies"]]
    chosen = [
        entry for entry in entries if dataset in (entry["datafile"]["original"], entry["name"])
    ]
    if not chosen:
        known = ", ".join(sorted({entry["name"] for entry in entries}))
        raise _Refused(f"expected the column dataset to name one of {known}; found {dataset!r}")
    if len(chosen) > 1:
        files = ", ".join(entry["datafile"]["original"] for entry in chosen)
        raise _Refused(f"expected one scan {dataset!r}, found {files}; name one of these instead")
    return chosen[0]


def _checked(topography, path, undefined_pixels):
    if topography.dim != 2:
        raise ValueError(f"{path}: expected a height map, found a line scan")
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise ValueError(
            f"{path}: expected a physical size and a unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )
    try:
        factor = get_unit_conversion_factor(topography.unit, "nm")
    except ValueError:
        raise ValueError(f"{path}: expected a unit of length, found {topography.unit!r}") from None
    if topography.has_undefined_data:
        topography = _filled(topography, path, undefined_pixels)
    heights = np.asarray(topography.heights(), dtype=float).T * factor
    if not np.isfinite(heights).all():
        raise ValueError(
            f"{path}: expected finite heights, "
            f"found {np.count_nonzero(~np.isfinite(heights))} that are not"
        )
    pixels = np.asarray(topography.physical_sizes, float) * factor / topography.nb_grid_pts
    if heights.shape[0] != heights.shape[1]:
        raise ValueError(
            f"{path}: expected a square scan, found {heights.shape[1]} x {heights.shape[0]} pixels"
        )
    if not (pixels > 0).all() or abs(pixels[0] / pixels[1] - 1) > 1e-3:
        raise ValueError(
            f"{path}: expected square pixels, found {pixels[0]:.6g} nm x {pixels[1]:.6g} nm"
        )
    return heights, float(pixels.mean())


def _filled(topography, path, method):
    count = int(np.ma.count_masked(topography.heights()))
    if method == "refuse":
        raise ValueError(
            f"{path}: expected no undefined pixels, found {count}; "
            "the key scan.undefined_pixels: harmonic fills them"
        )
    if count == topography.heights().size:
        raise ValueError(f"{path}: expected heights, found {count} undefined pixels and no other")
    return topography.interpolate_undefined_data(method)


def _library_map(heights, pixel_size):
    """The height map as SurfaceTopography knows it; its first axis is x."""
    sizes = tuple(count * pixel_size for count in heights.T.shape)
    return Topography(np.asarray(heights, dtype=float).T, sizes, unit="nm")


def level(heights, pixel_size):
    """Heights (y, x) in nm less their least-squares plane."""
    return _library_map(heights, pixel_size).detrend("height").heights().T


def subtract_sphere(heights, pixel_size, radius):
    """Roughness (y, x) in nm of a scan of the top of a sphere of `radius` (nm).

    The paraboloid x²/2R of the known radius is added back and the plane removed; where the apex
    lies does not matter, for moving it adds a plane.
    """
    y, x = (_centred(count) * pixel_size for count in heights.shape)
    return level(heights + (y[:, None] ** 2 + x**2) / (2 * radius), pixel_size)


def _centred(count):
    return np.arange(count) - (count - 1) / 2


def mirror_stitch(heights):
    """Periodic map (2y, 2x): the scan beside its mirror images, so that all edges match.

    Source: the paper, section Numerical Analysis of Results.
    """
    wide = np.concatenate([heights, heights[:, ::-1]], axis=1)
    return np.concatenate([wide, wide[::-1]], axis=0)


def metrics(heights, pixel_size):
    """The METRICS of a levelled, non-periodic scan (y, x) in nm, as a dict of floats.

    Derivatives are finite differences between neighbouring pixels, as in Table 1's source
    library; each definition that the paper leaves open stands under its own name.
    """
    topography = _library_map(heights, pixel_size)
    values = heights.ravel()
    half_laplacian = topography.rms_curvature_from_area()
    return {
        "rms_height": float(topography.rms_height_from_area()),
        "rms_gradient": float(topography.rms_gradient()),
        "rms_profile_slope": float(topography.rms_slope_from_profile()),
        "rms_half_laplacian": float(half_laplacian),
        "rms_laplacian": float(2 * half_laplacian),
        "skewness": float(skew(values)),
        "kurtosis": float(kurtosis(values, fisher=False)),
        "peak_to_valley": float(np.ptp(values)),
    }


def averages(scans, confidence):
    """Mean, standard deviation and confidence interval of the mean over scans, of every metric.

    scans: Dataset of METRICS over (surface, scan), NaN where a surface has no such scan. Student's
    t over scans gives the interval. Returns a dict of DataArrays named <metric>_mean, _std,
    _mean_low and _mean_high over surface.
    """
    found = {}
    for name in METRICS:
        values = scans[name]
        count, mean, std = values.count("scan"), values.mean("scan"), values.std("scan", ddof=1)
        reach = student_t.ppf((1 + confidence) / 2, count - 1) * std / np.sqrt(count)
        found |= {
            f"{name}_mean": mean,
            f"{name}_std": std,
            f"{name}_mean_low": mean - reach,
            f"{name}_mean_high": mean + reach,
        }
    return {
        key: value.assign_attrs(scans[key.split("_mean")[0].removesuffix("_std")].attrs)
        for key, value in found.items()
    }


def table1_variables(slope, curvature):
    """Which variable of the topography dataset is which row of Table 1, by the row's name.

    slope, curvature: keys of DEFINITIONS.
    """
    metrics = {
        "height": "rms_height",
        "slope": DEFINITIONS[slope],
        "curvature": DEFINITIONS[curvature],
    }
    return {f"afm_rms_{row}": f"{metric}_mean" for row, metric in metrics.items()} | {
        f"all_rms_{row}": f"all_scales_{metric}" for row, metric in metrics.items()
    }


def thinned(heights, pixels):
    """Every so-many-th pixel of a square map, pixels x pixels of them: for pictures."""
    chosen = np.linspace(0, heights.shape[0] - 1, pixels).round().astype(int)
    return heights[np.ix_(chosen, chosen)].astype(np.float32)
