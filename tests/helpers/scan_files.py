"""Write small scans and containers of scans, and truncate them."""

import zipfile

import numpy as np
import yaml
from SurfaceTopography import Topography
from SurfaceTopography.Container.SurfaceContainer import InMemorySurfaceContainer


def random_heights(*shape):
    """Return white Gaussian noise of unit variance, by default on 32 x 32 pixels."""
    return np.random.default_rng(1).standard_normal(shape or (32, 32))


def write_scan(path, values=None, sizes=(320.0, 320.0), unit="nm"):
    """Write a map whose first axis is x, by default noise on pixels of 10 nm."""
    Topography(random_heights() if values is None else values, sizes, unit=unit).to_netcdf(
        str(path)
    )
    return path


def write_container(path, entries, files):
    """Write a container with entries of scans in its meta.yml, and files: name -> path."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("meta.yml", yaml.safe_dump({"surfaces": [{"topographies": entries}]}))
        for name, file in files.items():
            archive.write(file, name)
    return path


def truncate_file(path, share):
    """Keep the first share of a file's bytes."""
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    return path


def filled_heights(topography):
    """Return heights with NaN where they are undefined; first axis x."""
    return np.ma.filled(topography.heights().astype(float), np.nan)


def write_coordinates(topography, path):
    """Write a text of positions and heights, in the layout of Gwyddion."""
    sizes, counts = topography.physical_sizes, topography.nb_grid_pts
    if topography.dim == 1:
        axes = [topography.positions()]
    else:
        spaced = [np.arange(n) * size / n for n, size in zip(counts, sizes, strict=True)]
        axes = np.meshgrid(*spaced, indexing="ij")
    columns = [axis.ravel() for axis in (*axes, filled_heights(topography))]
    units = f"Lateral units: {topography.unit}\nValue units: {topography.unit}"
    np.savetxt(path, np.column_stack(columns), header=units)


def write_described_array(topography, path):
    """Write a container of an array of numpy, whose size and unit the container states."""
    array = path.with_suffix(".npy")
    np.save(array, filled_heights(topography))
    size = [float(size) for size in topography.physical_sizes]
    entry = {"name": "one", "datafile": {"original": "a.npy"}, "size": size}
    write_container(path, [entry | {"unit": topography.unit}], {"a.npy": array})


#: Writers of a map or a line scan of SurfaceTopography to a path, by the suffix of the file.
SCAN_WRITERS = {
    "nc": lambda topography, path: topography.to_netcdf(str(path)),
    "asc": lambda topography, path: topography.to_matrix(str(path)),
    "xyz": write_coordinates,
    "array.zip": write_described_array,
    "zip": lambda topography, path: InMemorySurfaceContainer([topography]).to_zip(str(path)),
}
#: Writers of a map, also those that take no line scan.
MAP_WRITERS = SCAN_WRITERS | {
    "gwy": lambda topography, path: topography.to_gwy(str(path)),
    "x3p": lambda topography, path: topography.to_x3p(str(path)),
}


def write_nanoscope(path, counts, size, channels=("Height",)):
    """Write a Nanoscope file of a size (nm) with counts (y, x) of 0.1 nm in every channel.

    The first line of the counts is the top of the scan. A channel Phase is in degrees.
    """
    rows, columns = counts.shape
    data = np.asarray(counts, "<i2").tobytes()
    data_offset = 4096  # any number of bytes that the header does not exceed
    header = [r"\*File list", r"\Version: 0x07200000", r"\*Scanner list"]
    header += [r"\@Sens. Zsens: V 10 nm/V", r"\@Sens. Phase: V 1 deg/V"]
    for number, channel in enumerate(channels):
        sensitivity = "Phase" if channel == "Phase" else "Zsens"
        header += [r"\*Ciao image list", rf"\Samps/line: {columns}", rf"\Number of lines: {rows}"]
        header += [rf"\Scan Size: {size[0]} {size[1]} nm", rf"\Data length: {len(data)}"]
        header += [rf"\Data offset: {data_offset + number * len(data)}", r"\Bytes/pixel: 2"]
        header += [rf"\@2:Image Data: S [{channel}] \"{channel}\""]
        header += [rf"\@2:Z scale: V [Sens. {sensitivity}] (0.01 V/LSB) {0.01 * 2**16} V"]
    text = "\r\n".join([*header, r"\*File list end", ""]).encode("latin-1")
    path.write_bytes(text.ljust(data_offset, b"\0") + data * len(channels))
    return path
