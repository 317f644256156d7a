"""Draw a figure of the catalogue from its datasets, and write it as PDF and PNG with its table."""

import importlib
from collections.abc import Mapping
from contextlib import ExitStack

import pandas as pd
from matplotlib.figure import Figure

from hardcontact.figures import style
from hardcontact.figures.catalogue import FIGURES, OF_ATOMIC
from hardcontact.records import dataset, published
from hardcontact.records.whole_file import whole_file

RESOLUTION = 300  # dots per inch of the PNG and of the maps inside the PDF
READERS = {
    "published_constants": published.constants,
    "published_pull_off": published.pull_off,
    "published_table1": published.table1,
}


def draw_figure(name: str, inputs: Mapping[str, str], outputs: Mapping[str, str]) -> None:
    """Draw a figure of the catalogue, named by a key of `FIGURES` or of `OF_ATOMIC`.

    Inputs are the paths of the datasets and published tables that it is drawn from, outputs those
    of its "pdf", "png" and "csv".
    """
    module = importlib.import_module(f"hardcontact.figures.{name}")
    figure = (FIGURES | OF_ATOMIC)[name]
    drawn_from = {key: READERS.get(key, dataset.read)(inputs[key]) for key in figure.inputs}
    save(module.draw(**drawn_from), module.table(**drawn_from), figure.title, outputs)


@style.print_style()
def save(figure: Figure, table: pd.DataFrame, title: str, outputs: Mapping[str, str]) -> None:
    """Write a figure and the table of its numbers as "pdf", "png" and "csv", with its title.

    The bytes are the same each time, and all files are written or none.
    """
    style.freeze_layout(figure)
    with ExitStack() as stack:
        pdf, png, csv = (
            stack.enter_context(whole_file(outputs[kind])) for kind in ("pdf", "png", "csv")
        )
        table.to_csv(csv, index=False, float_format="%.8g", lineterminator="\n")
        figure.savefig(
            png, format="png", dpi=RESOLUTION, metadata={"Title": title, "Software": None}
        )
        figure.savefig(
            pdf, format="pdf", dpi=RESOLUTION, metadata={"Title": title, "CreationDate": None}
        )
