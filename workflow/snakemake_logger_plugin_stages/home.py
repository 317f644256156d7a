"""A user without a name or a home folder, as in a container with a foreign user number."""

import getpass
import os
from contextlib import suppress
from pathlib import Path


def provide_home(folder: Path) -> None:
    """Name an unknown user by number, and use a folder in place of a home that takes no files.

    Snakemake needs both: it logs the name, and keeps copies of the rules in the home folder.
    """
    try:
        getpass.getuser()
    except (KeyError, OSError):
        os.environ["USER"] = str(os.getuid())
    if not os.access(os.path.expanduser("~"), os.W_OK):
        with suppress(OSError):  # The run itself refuses a folder that takes no files.
            folder.mkdir(parents=True, exist_ok=True)
            os.environ["HOME"] = str(folder.absolute())
