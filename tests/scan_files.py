"""Small scans and containers of scans, whole or cut short."""

import zipfile

import numpy as np
import yaml
from SurfaceTopography import Topography


def heights(*shape):
    """Return random heights, on 32 x 32 pixels if nothing else is said."""
    return np.random.default_rng(1).standard_normal(shape or (32, 32))


def scan(path, values=None, sizes=(320.0, 320.0), unit="nm"):
    """Write a scan of 10 nm a pixel, or of other sizes; first axis x."""
    Topography(heights() if values is None else values, sizes, unit=unit).to_netcdf(str(path))
    return path


def container(path, entries, files):
    """Write a container with these entries of meta.yml and these files: name -> path."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("meta.yml", yaml.safe_dump({"surfaces": [{"topographies": entries}]}))
        for name, file in files.items():
            archive.write(file, name)
    return path


def cut(path, share):
    """Keep the first share of a file's bytes."""
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    return path
