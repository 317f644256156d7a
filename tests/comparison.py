"""Whether two results folders hold the same: every file of the studies and of their stores."""

import xarray as xr

#: Folders that tell of a run and not of its results.
OF_THE_RUN = {"logs", "benchmarks"}


def paths(results):
    """Paths in `results` of all files but those that tell of a run."""
    found = (path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {path for path in found if not OF_THE_RUN & set(path.parts) and path.name != ".lock"}


def same(one, other):
    """Two datasets hold the same values, coordinates and attributes; other files the same bytes."""
    if one.suffix != ".nc":
        return one.read_bytes() == other.read_bytes()
    with xr.open_dataset(one) as left, xr.open_dataset(other) as right:
        return left.identical(right)


def differences(made, reference):
    """What is not in both results folders or not the same in both, a line each."""
    there, expected = paths(made), paths(reference)
    lines = [f"{path}: missing" for path in expected - there]
    lines += [f"{path}: not in the reference" for path in there - expected]
    lines += [
        f"{path}: differs from the reference"
        for path in there & expected
        if not same(made / path, reference / path)
    ]
    return sorted(lines)
