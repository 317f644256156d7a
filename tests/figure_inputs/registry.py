"""Every input of a figure by its name in the catalogue."""

import importlib
from types import ModuleType

import pandas as pd
import xarray as xr

from figure_inputs.adhesion import adhesion, inference, robustness
from figure_inputs.classical import classical
from figure_inputs.closed_form import closed_form
from figure_inputs.contact import asperities, contact, elastic, indent
from figure_inputs.elastic_limit import elastic_limit
from figure_inputs.laws import laws
from figure_inputs.published_tables import (
    published_constants,
    published_pull_off,
)
from figure_inputs.scales import band, scales
from figure_inputs.scaling import scaling
from figure_inputs.scan_size import scan_size
from figure_inputs.sets import sets
from figure_inputs.statistics import statistics
from figure_inputs.surfaces import topography
from hardcontact.figures.catalogue import FIGURES

#: What makes each input.
INPUTS = {
    make.__name__: make
    for make in (
        topography,
        adhesion,
        contact,
        inference,
        band,
        scales,
        sets,
        indent,
        elastic,
        asperities,
        classical,
        robustness,
        closed_form,
        laws,
        statistics,
        elastic_limit,
        scaling,
        scan_size,
        published_constants,
        published_pull_off,
    )
}


def module_of(figure: str) -> ModuleType:
    """Return the module of a figure."""
    return importlib.import_module(f"hardcontact.figures.{figure}")


def inputs_of(figure: str) -> dict[str, xr.Dataset | pd.DataFrame]:
    """Return new inputs of a figure, by the names of its arguments."""
    return {name: INPUTS[name]() for name in FIGURES[figure].inputs}
