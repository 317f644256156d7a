"""Pinned and installed versions of the packages that a study needs."""

import re
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from hardcontact.base.dataset import atomic_file, remove_parts

#: The file of the packages that the study imports.
ENVIRONMENT = "environment.txt"
#: The file of these packages and of all that they need in turn.
LOCK = "workflow/lock.txt"
#: Copies of both without comments and hashes. Jobs depend on these: no comment makes a file stale.
PINS = tuple(f"results/{Path(path).name}" for path in (ENVIRONMENT, LOCK))
#: The command that installs the pinned versions.
INSTALL = f"pip install --require-hashes -r {LOCK}"
#: A line such as ``numpy==2.3.1``: name and version.
PIN = re.compile(r"^([\w.-]+)(?:\[[^]]*\])?==([^\s;\\]+)", re.MULTILINE)


def read_pins(path: str | Path) -> dict[str, str]:
    """Return the pinned versions in a requirements file, by package, in the order of the file."""
    return dict(PIN.findall(Path(path).read_text("utf-8")))


def write_pins() -> None:
    """Write PINS, unless the files are right already."""
    for source, path in zip((ENVIRONMENT, LOCK), PINS, strict=True):
        text = "".join(f"{name}=={pin}\n" for name, pin in read_pins(source).items())
        if not Path(path).is_file() or Path(path).read_text("utf-8") != text:
            remove_parts(path)
            with atomic_file(path) as temporary:
                Path(temporary).write_text(text, "utf-8")


def refuse_other_versions() -> None:
    """Raise ValueError, in one line, if an installed version is not the pinned one."""
    locked = _normalize_names(read_pins(LOCK))
    required = _normalize_names(read_pins(ENVIRONMENT))
    if not required.items() <= locked.items():
        names = ", ".join(sorted(name for name, pin in required.items() if locked.get(name) != pin))
        raise ValueError(
            f"{LOCK}: expected {names} as pinned in {ENVIRONMENT}, found another version or none; "
            "make it anew by .ci/lock"
        )
    installed = {name: installed_version(name) for name in locked}
    faults = [
        f"{name} {pin}, found {installed[name] or 'none'}"
        for name, pin in locked.items()
        # A package that only some systems need may be missing.
        if installed[name] != pin and (installed[name] or name in required)
    ]
    if faults:
        raise ValueError(f"packages: expected {'; '.join(faults)} (mend it: {INSTALL})")


def _normalize_names(pins: dict[str, str]) -> dict[str, str]:
    """Return pins by the name that pip compares: without case, ``-``, ``_`` and ``.`` alike."""
    return {re.sub(r"[-_.]+", "-", name).lower(): pin for name, pin in pins.items()}


@cache
def installed_version(name: str) -> str | None:
    """Return the installed version of a package, None if there is none."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None
