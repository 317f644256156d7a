"""The folders that commands read, and the files and tables that they write."""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from hardcontact.base.atomic_file import write_text_file


def results_folder(path: str) -> Path:
    """Return the folder of a study's results, given by its path or by the name of the study."""
    folder = Path("results", path)
    return folder if folder.is_dir() and not Path(path).is_dir() else Path(path)


def output_faults(
    option: str, path: str | None, inputs: Mapping[str, str], overwrite: bool
) -> Iterator[str]:
    """Yield a line if the output of an option cannot be written, or would replace a file.

    `inputs` are words for files read, such as "that of the surface", by path.
    """
    if path is None or path == "-":
        return
    real_path = Path(path).resolve()
    input_words = {Path(name).resolve(): words for name, words in inputs.items()}
    if real_path in input_words:
        yield f"--{option}: expected another file than {input_words[real_path]}, found {path}"
    elif not real_path.parent.is_dir() or real_path.is_dir():
        yield f"--{option}: expected a file in a folder that exists, found {path}"
    elif real_path.is_file() and not overwrite:
        yield (
            f"--{option}: expected a new file, found {path}: take another name, or add --overwrite"
        )


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
    """Write a file completely or not at all, except pipes and devices."""
    if Path(path).exists() and not Path(path).is_file():
        Path(path).write_text(text, "utf-8")
        return
    write_text_file(os.path.realpath(path), text)
