"""Writing a figure: the same bytes each time, all files or none, images where points are many."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from hardcontact.report.figures import drawing, style

SURFACES = xr.Dataset(
    {"label": ("surface", ["UNCD", "NCD"]), "source": ("surface", ["measured", "substitute"])}
)


def simple_figure():
    figure = drawing.create_figure(3, SURFACES)
    figure.subplots().plot(np.linspace(0, 1, 10))
    return figure


def outputs(folder: Path) -> dict[str, str]:
    folder.mkdir(exist_ok=True)
    return {suffix: str(folder / f"figure.{suffix}") for suffix in drawing.FIGURE_SUFFIXES}


def test_drawing_twice_gives_the_same_bytes(tmp_path):
    contents = []
    for folder in (tmp_path / "first", tmp_path / "second"):
        with style.print_style():
            drawing.save_figure(simple_figure(), "a figure", outputs(folder))
        contents.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert contents[0] == contents[1] and len(contents[0]) == len(drawing.FIGURE_SUFFIXES)
    assert contents[0]["figure.pdf"].startswith(b"%PDF") and b"<svg" in contents[0]["figure.svg"]
    with Image.open(tmp_path / "first/figure.png") as image:
        assert image.size == (drawing.WIDTH * drawing.RESOLUTION, 3 * drawing.RESOLUTION)


def test_a_figure_names_only_the_substitutes():
    (note,) = simple_figure().texts
    assert note.get_text().startswith("substitute surfaces: NCD (")
    all_measured = SURFACES.assign(source=("surface", ["measured"] * 2))
    assert drawing.create_figure(3, all_measured).texts[0].get_text() == "all surfaces measured"


def test_nothing_is_written_when_saving_fails(tmp_path, monkeypatch):
    def write_half(path, _):
        with open(path, "w", encoding="utf-8") as file:
            file.write("half")
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_bytes", write_half)  # of the last file, the SVG
    with pytest.raises(ValueError, match="figure.svg: expected a file to be written, found: disk"):
        drawing.save_figure(simple_figure(), "a figure", outputs(tmp_path))
    assert not list(tmp_path.iterdir())
