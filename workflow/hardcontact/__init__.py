"""Adhesion of hard, rough contacts: from height maps to pull-off forces and the scales that matter.

The subpackages are layers. Each imports only from itself and from earlier ones in this order:
`base`, `records`, `surfaces`, `scans`, `contact`, `inference`, `theory`, `config`, `paper`,
`own`, `files`, `run`, `report`, `commands`. workflow/README.md says what each layer holds. Programs
import the functions of the module `api` from this package. Functions load when they are first used,
so that no job of the study depends on them.
"""

import importlib
from typing import Any

#: What programs use of the library; each is defined in `api` or imported there.
API = (
    "HeightMap", "Spectrum", "force_ratios", "from_topography", "measured_psds", "metrics",
    "predict", "pull_off_forces", "read_scan", "read_spectrum",
)  # fmt: skip


def __getattr__(name: str) -> Any:
    """Return the function or class that `API` names, or the version of the library."""
    if name == "__version__":
        return importlib.import_module("importlib.metadata").version("hardcontact")
    if name not in API:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module("hardcontact.api"), name)


def __dir__() -> list[str]:
    """Return the public names of the library."""
    return [*API, "__version__"]
