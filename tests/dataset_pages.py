"""The variables of datasets, on the page that describes them and in a folder of results."""

import re

from hardcontact.base import dataset
from hardcontact.report.dataset_dictionary import PAGE, meanings, rows_of

#: Datasets that studies of the paper and of own surfaces make, not with the same variables.
SHARED = {"adhesion", "edges", "fit", "scales", "topography"}


def described_rows():
    """Return the names of variables on the page, by dataset."""
    _, *sections = re.split(r"^## (\w+)\.nc$", PAGE.read_text("utf-8"), flags=re.M)
    return {
        name: set(re.findall(r"^\| (`.+?) \| ", text, re.M))
        for name, text in zip(sections[::2], sections[1::2], strict=True)
    }


def made_variables(results):
    """Return the names of variables of the datasets in a folder of results."""
    variable_meanings = meanings()
    return {
        path.stem: set(rows_of(path.stem, dataset.read(path), variable_meanings))
        for path in results.glob("*.nc")
    }
