"""Whether two results folders hold the same, and are whole: files of the studies and stores."""

import xarray as xr

from hardcontact.base import dataset
from hardcontact.base.whole_file import PART

#: Folders of files that belong to one run and not to its results.
OF_THE_RUN = {"logs", "benchmarks", ".origin"}


def paths(results):
    """Return the paths in `results` of all files but those that belong to one run."""
    files = (path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {path for path in files if not OF_THE_RUN & set(path.parts)}


def same(one, other):
    """Say whether datasets hold the same values and attributes, other files the same bytes."""
    if one.suffix != ".nc":
        return one.read_bytes() == other.read_bytes()
    with xr.open_dataset(one) as left, xr.open_dataset(other) as right:
        return left.identical(right)


def differences(made, reference):
    """Return what is not in both results folders or not the same in both, a line each."""
    there, expected = paths(made), paths(reference)
    lines = [f"{path}: missing" for path in expected - there]
    lines += [f"{path}: not in the reference" for path in there - expected]
    lines += [
        f"{path}: differs from the reference"
        for path in there & expected
        if not same(made / path, reference / path)
    ]
    return sorted(lines)


def damaged(results):
    """Return what is wrong with the datasets in a folder that do not read: they must be whole."""
    lines = []
    for path in results.rglob("*.nc"):
        if not path.name.startswith(PART):
            try:
                dataset.read(path)
            except ValueError as error:
                lines.append(str(error))
    return lines
