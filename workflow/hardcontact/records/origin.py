"""What determined a file: parameters, inputs, code and the versions of packages."""

import hashlib
import json
import re
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import NamedTuple

#: Packages whose versions every file names.
PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "SurfaceTopography", "snakemake")


def canonical(parameters: object) -> str:
    """Return parameters as one sorted JSON text: equal text means equal parameters."""
    return json.dumps(parameters, sort_keys=True, ensure_ascii=False, separators=(",", ":"))


def digest(paths: Iterable[str | Path]) -> str:
    """Return the SHA-256 over the contents of files, in the given order."""
    total = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            total.update(hashlib.file_digest(file, "sha256").digest())
    return total.hexdigest()


def digests(paths: Iterable[str | Path]) -> str:
    """Return the SHA-256 of each of the files by itself, by path, as canonical text."""
    return canonical({Path(path).as_posix(): digest([path]) for path in set(paths)})


class Origin(NamedTuple):
    """What a file was made from."""

    parameters: str  #: Canonical JSON text.
    inputs: list[str]  #: Paths whose digests are kept one by one.
    code: list[str]  #: Paths among the inputs that are also digested together.

    def attributes(self) -> dict[str, str]:
        """Return the origin as texts: equal texts mean an equal file.

        The time of writing is not among them: it would differ between equal files.
        """
        return {
            "parameters": self.parameters,
            "versions": canonical({name: version(name) for name in PACKAGES}),
            "code_digest": digest(self.code),
            "input_digests": digests(self.inputs),
        }


def pinned_versions(environment: str | Path) -> dict[str, str]:
    """Return the installed versions of the packages that requirements of pip pin, in their order.

    Only lines ``package==version`` count; a ValueError of one line names one that is not installed.
    """
    names = re.findall(r"^([\w.-]+)(?:\[[^]]*\])?==", Path(environment).read_text("utf-8"), re.M)
    try:
        return {name: version(name) for name in names}
    except PackageNotFoundError as error:
        raise ValueError(
            f"{environment}: expected the package {error.name} to be installed, found none"
        ) from None
