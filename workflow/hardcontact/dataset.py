"""Datasets on disk: whole or absent, with their provenance, checked when read."""

import hashlib
import json
import os
import shutil
import tempfile
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

__all__ = [
    "atomic_path",
    "canonical",
    "digest",
    "digests",
    "height_map",
    "pixel_size",
    "provenance",
    "read",
    "record",
    "remove_parts",
    "stack",
    "write",
]

#: How the name of a file begins that is not whole yet.
PART = ".part-"
PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "SurfaceTopography", "snakemake")


def canonical(parameters):
    """Parameters as one sorted JSON text: equal text means equal parameters."""
    return json.dumps(parameters, sort_keys=True, ensure_ascii=False, separators=(",", ":"))


def digest(paths):
    """SHA-256 over the contents of files, in the given order."""
    total = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            total.update(hashlib.file_digest(file, "sha256").digest())
    return total.hexdigest()


def digests(paths):
    """SHA-256 of each of the files by itself, by path, as canonical text."""
    return canonical({Path(path).as_posix(): digest([path]) for path in set(paths)})


@contextmanager
def atomic_path(path):
    """A temporary path beside `path`, renamed to it if the block succeeds, removed if it fails.

    Raises ValueError, in one line, if the file cannot be written.
    """
    path = Path(path)
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=PART, suffix=path.suffix)
        os.close(handle)
        yield temporary
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise ValueError(
            f"{path}: expected a file to be written, found: {error.strerror or error}; "
            f"{_free(path.parent):.1f} MB of the disk are free"
        ) from error
    finally:
        if temporary:
            Path(temporary).unlink(missing_ok=True)


def _free(folder):
    while not folder.exists():
        folder = folder.parent
    return shutil.disk_usage(folder).free / 1e6


def remove_parts(folder):
    """Remove what jobs that were killed left half-written anywhere below `folder`."""
    for path in Path(folder).rglob(f"{PART}*"):
        path.unlink(missing_ok=True)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def height_map(heights, pixel, *, periodic, **attributes):
    """Dataset of one height map.

    heights: (y, x) in nm, stored as float32; pixel: edge of a pixel in nm; periodic: whether
    the map continues itself at its edges. Other attributes are kept as given.
    """
    coordinates = {
        axis: (
            axis,
            (0.5 + np.arange(count)) * pixel,
            {"units": "nm", "long_name": f"{axis} position"},
        )
        for axis, count in zip("yx", heights.shape, strict=True)
    }
    return xr.Dataset(
        {
            "heights": (
                ("y", "x"),
                heights.astype("float32"),
                {"units": "nm", "long_name": "surface height", "pixel_size": float(pixel)},
            )
        },
        coordinates,
        {"periodic": int(periodic), **attributes},
    )


def pixel_size(surface):
    """Edge of a pixel in nm of a dataset made by `height_map`."""
    return float(surface["heights"].attrs["pixel_size"])


def provenance(parameters, inputs, code):
    """What determined a file, as a dict of texts: equal texts mean an equal file.

    parameters: canonical JSON text; inputs: paths whose digests are kept one by one; code: those
    among them that are also digested together. No time of writing, so that nothing else differs.
    """
    return {
        "parameters": parameters,
        "versions": canonical({name: version(name) for name in PACKAGES}),
        "code_digest": digest(code),
        "input_digests": digests(inputs),
    }


def write(dataset, path, *, title, parameters, inputs, code, file_format="NETCDF4"):
    """Write `dataset` whole or not at all, with what determined it (see `provenance`)."""
    dataset = dataset.assign_attrs(
        title=title,
        Conventions="CF-1.11",
        history=f"made by the hardcontact study: {title}",
        **provenance(parameters, inputs, code),
    )
    with atomic_path(path) as temporary:
        try:
            dataset.to_netcdf(temporary, format=file_format, engine="netcdf4")
        except RuntimeError as error:  # netCDF's name for whatever the system refused
            raise OSError(str(error)) from error


def record(path, outputs, *, parameters, inputs, code):
    """Write beside files without attributes (figures, tables, pages) what determined them, as JSON.

    outputs: the files, whose digests are kept too; for the others see `provenance`.
    """
    found = provenance(parameters, inputs, code) | {"output_digests": digests(outputs)}
    with atomic_path(path) as temporary:
        Path(temporary).write_text(canonical(found))


def read(path):
    """Read a dataset into memory.

    Raises ValueError, in one line, if the file is missing, damaged or truncated.
    """
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            return dataset.load()
    except (OSError, RuntimeError, ValueError) as error:
        reason = str(error).splitlines()[0]
        raise ValueError(
            f"{path}: expected a complete netCDF file, found: {reason}; delete it and run again"
        ) from None


def stack(parts, dimensions):
    """One dataset from many, along new dimensions in the order in which their keys come.

    parts: tuple of keys -> Dataset; dimensions: their names, outermost first. Where a combination
    is missing the values are NaN.
    """
    if not dimensions:
        return parts[()]
    groups = {}
    for (first, *rest), part in parts.items():
        groups.setdefault(first, {})[tuple(rest)] = part
    inner = [stack(group, dimensions[1:]) for group in groups.values()]
    return xr.concat(inner, pd.Index(list(groups), name=dimensions[0]), join="outer")
