"""Drawing a figure: its style and note, the same bytes each time, all files or none."""

from pathlib import Path

import pandas as pd
import pytest
import xarray as xr
from figure_inputs.registry import inputs_of, module_of
from figure_inputs.surfaces import topography
from matplotlib import rc_context, rcParams

from hardcontact.config.patterns import PUBLISHED
from hardcontact.figures import drawing, fig1
from hardcontact.figures.catalogue import FIGURES

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    monkeypatch.setattr(drawing, "RESOLUTION", 40)


def outputs(folder: Path) -> dict[str, str]:
    folder.mkdir(exist_ok=True)
    return {kind: str(folder / f"figure.{kind}") for kind in drawing.KINDS}


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def input_files(name: str, folder: Path) -> dict[str, str]:
    """Write the datasets that a figure is drawn from, and return the paths of all its inputs."""
    inputs = {key: str(ROOT / PUBLISHED[key]) for key in FIGURES[name].published}
    for key in FIGURES[name].datasets:
        inputs[key] = str(folder / f"{key}.nc")
        inputs_of(name)[key].to_netcdf(inputs[key])
    return inputs


#: What draws fast; the others are drawn from their files in the tier of studies.
FAST = "fig_asperities"
slow = [pytest.param(name, marks=pytest.mark.study) for name in FIGURES if name != FAST]


@pytest.mark.parametrize("name", [FAST, *slow])
def test_a_figure_is_drawn_from_its_files(name, tmp_path):
    drawing.draw_figure(name, input_files(name, tmp_path), outputs(tmp_path / "made"))
    made = contents(tmp_path / "made")
    assert set(made) == {f"figure.{kind}" for kind in drawing.KINDS}
    assert made["figure.pdf"].startswith(b"%PDF") and made["figure.png"].startswith(b"\x89PNG")
    assert b"<svg" in made["figure.svg"]
    assert made["figure.csv"].count(b"\n") > 10


@pytest.mark.parametrize(
    "name", [FAST, *(one for one in slow if one.values[0] in ("fig1", "fig4", "fig5"))]
)
def test_drawing_twice_gives_the_same_bytes(name, tmp_path):
    for folder in (tmp_path / "first", tmp_path / "second"):
        module, inputs = module_of(name), inputs_of(name)
        drawing.save(module.draw(**inputs), module.table(**inputs), "a figure", outputs(folder))
    assert contents(tmp_path / "first") == contents(tmp_path / "second")


def test_a_figure_is_drawn_and_saved_in_the_style_of_print_alone(monkeypatch, tmp_path):
    sizes = []
    for module, function in ((module_of(FAST), "draw"), (drawing, "save")):
        monkeypatch.setattr(module, function, lambda *_, **__: sizes.append(rcParams["font.size"]))
    with rc_context({"font.size": 11}):
        before = dict(rcParams)
        drawing.draw_figure(FAST, input_files(FAST, tmp_path), {})
        assert dict(rcParams) == before
    assert sizes == [8, 8]


def test_only_the_substitutes_are_named():
    surfaces = xr.Dataset(
        {
            "label": ("surface", ["UNCD", "NCD"]),
            "basis": ("surface", ["measured", "substitute"]),
        }
    )
    (note,) = drawing.create(3, surfaces).texts
    assert note.get_text().startswith("substitute surfaces: NCD (")


def test_nothing_is_written_when_saving_fails(tmp_path):
    class Broken(pd.DataFrame):
        def to_csv(self, path, **_):
            Path(path).write_text("half")
            raise OSError("disk full")

    with pytest.raises(ValueError, match="figure.csv: expected a file to be written, found: disk"):
        drawing.save(fig1.draw(topography()), Broken(), "a figure", outputs(tmp_path))
    assert not list(tmp_path.iterdir())
