"""What determined a file: parameters, inputs, code and the versions of packages."""

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import NamedTuple

from hardcontact.records.whole_file import whole_file

#: Packages whose versions every file names.
PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "SurfaceTopography", "snakemake")

#: The folder of the digests of files, beside them.
KEPT = ".sha256"


def canonical(parameters: object) -> str:
    """Return parameters as one sorted JSON text: equal text means equal parameters."""
    return json.dumps(parameters, sort_keys=True, ensure_ascii=False, separators=(",", ":"))


def digest(path: str | Path) -> str:
    """Return the SHA-256 of the content of a file."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def digests(paths: Iterable[str | Path]) -> dict[str, str]:
    """Return the SHA-256 of each of the files, by path."""
    return {Path(path).as_posix(): digest(path) for path in set(paths)}


def keep_digests(paths: Iterable[str | Path]) -> None:
    """Keep the SHA-256 of files that a job has made in KEPT beside them, as `sha256sum` does."""
    for path, value in digests(paths).items():
        with whole_file(_kept(path)) as temporary:
            Path(temporary).write_text(f"{value}  {Path(path).name}\n", "utf-8")


def kept_digest(path: str | Path) -> str | None:
    """Return the SHA-256 that a file had when it was made, None of one that no job made."""
    kept = _kept(path)
    return kept.read_text("utf-8", "replace").partition(" ")[0] if kept.is_file() else None


def refuse_changed(found: Mapping[str, str]) -> None:
    """Refuse files, given with their SHA-256, that are not as a job made them, in one line."""
    changed = [path for path in sorted(found) if kept_digest(path) not in (None, found[path])]
    if changed:
        said = (
            f"{path}: expected the file that the study wrote, found another" for path in changed
        )
        raise ValueError("; ".join(said) + "; delete it and run again")


def _kept(path: str | Path) -> Path:
    # A search for *.nc finds datasets alone.
    return Path(path).parent / KEPT / f"{Path(path).name}.sha256"


class Origin(NamedTuple):
    """What a file was made from."""

    parameters: str  #: Canonical JSON text.
    inputs: dict[str, str]  #: SHA-256 by path.
    code: list[str]  #: Paths among the inputs that are also digested together.

    def attributes(self) -> dict[str, str]:
        """Return the origin as texts: equal texts mean an equal file.

        The time of writing is not among them: it would differ between equal files.
        """
        code = canonical({path: self.inputs[path] for path in self.code})
        return {
            "parameters": self.parameters,
            "versions": canonical({name: version(name) for name in PACKAGES}),
            "code_digest": hashlib.sha256(code.encode()).hexdigest(),
            "input_digests": canonical(self.inputs),
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
