"""Compare results folders, and find damaged datasets and variables without a meaning."""

import xarray as xr

from hardcontact.base.atomic_file import INCOMPLETE_PREFIX
from hardcontact.base.dataset import read_dataset

#: Folders of files that belong to one run and not to its results.
RUN_FOLDERS = {"logs", "benchmarks", ".origin"}


def result_paths(results):
    """Return the paths in `results` of all files but those that belong to one run."""
    files = (path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {path for path in files if not RUN_FOLDERS & set(path.parts)}


def equal_files(path, reference):
    """Return True for equal datasets, or other files with equal bytes."""
    if path.suffix != ".nc":
        return path.read_bytes() == reference.read_bytes()
    with xr.open_dataset(path) as data, xr.open_dataset(reference) as reference_data:
        return data.identical(reference_data)


def differences(folder, reference):
    """Return a line for each file that only one of two results folders has, or that differs."""
    relative_paths, reference_paths = result_paths(folder), result_paths(reference)
    lines = [f"{path}: missing" for path in reference_paths - relative_paths]
    lines += [f"{path}: not in the reference" for path in relative_paths - reference_paths]
    lines += [
        f"{path}: differs from the reference"
        for path in relative_paths & reference_paths
        if not equal_files(folder / path, reference / path)
    ]
    return sorted(lines)


def damaged_datasets(results):
    """Return a line for each dataset that cannot be read; incomplete ones may stay after a kill."""
    lines = []
    for path in results.rglob("*.nc"):
        if not path.name.startswith(INCOMPLETE_PREFIX):
            try:
                read_dataset(path)
            except ValueError as error:
                lines.append(str(error))
    return lines


def undescribed_variables(folder):
    """Return the variables in a folder of results without a meaning, and numbers without a unit."""
    return [
        (path.stem, name)
        for path in folder.glob("*.nc")
        for name, variable in read_dataset(path).variables.items()
        if not variable.attrs.get("long_name")
        or (variable.dtype.kind in "biuf" and not variable.attrs.get("units"))
    ]
