"""The files and tables that commands write.

No command replaces an input; it replaces other files only with --overwrite.
"""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from hardcontact.base.dataset import atomic_file


def output_faults(
    outputs: Mapping[str, str | None], inputs: Mapping[str, str], overwrite: bool
) -> Iterator[str]:
    """Yield a line for each output that cannot be written, or would replace a file.

    `outputs` are paths by option: None if not asked for, - for the terminal. `inputs` are words
    such as "that of the surface", by path.
    """
    reserved = {
        os.path.realpath(path): f"another file than {words}" for path, words in inputs.items()
    }
    for option, path in outputs.items():
        if path is None:
            continue
        real_path = path if path == "-" else os.path.realpath(path)
        if real_path in reserved:
            yield f"--{option}: expected {reserved[real_path]}, found {path}"
        elif path != "-" and (not Path(real_path).parent.is_dir() or Path(real_path).is_dir()):
            yield f"--{option}: expected a file in a folder that exists, found {path}"
        elif Path(real_path).is_file() and not overwrite:
            yield (
                f"--{option}: expected a new file, found {path}: take another name, or add "
                "--overwrite"
            )
        reserved[real_path] = f"another file than that of --{option}"


def align_cells(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the rows as lines, with cells in columns; the last cell of a row may be longer."""
    columns = max(map(len, rows))
    padded = [[*row, *[""] * (columns - len(row))] for row in rows]
    widths = [
        max((len(row[column]) for row in rows if len(row) > column + 1), default=0)
        for column in range(columns)
    ]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in padded]


def write_output(path: str, text: str) -> None:
    """Write a file completely; pipes and devices take the text as it comes."""
    if Path(path).exists() and not Path(path).is_file():
        Path(path).write_text(text, "utf-8")
        return
    with atomic_file(os.path.realpath(path)) as temporary:
        Path(temporary).write_text(text, "utf-8")
