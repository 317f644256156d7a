"""The variables of finished studies that lack a unit or a meaning."""

from hardcontact.base import dataset


def undescribed(folder):
    """Return the variables in a folder of results without a meaning, and numbers without a unit."""
    return [
        (path.stem, name)
        for path in folder.glob("*.nc")
        for name, variable in dataset.read(path).variables.items()
        if not variable.attrs.get("long_name")
        or (variable.dtype.kind in "biuf" and not variable.attrs.get("units"))
    ]
