"""Registry of the numbers that claims are about: variables of datasets, and derived quantities.

A number is a dataset of `value` and `value_interval`, as `numbers.number` returns it.
"""

import json

import xarray as xr

from hardcontact.claims import (
    classical_quantities,
    contact_quantities,
    force_quantities,
    inference_quantities,
    roughness_quantities,
    scale_quantities,
)
from hardcontact.claims.numbers import variable_as_number

__all__ = ["DERIVED", "estimate"]

#: Functions of one dataset or several, by the name that a claim gives the quantity.
DERIVED = {
    name: getattr(module, name)
    for module in (
        classical_quantities,
        contact_quantities,
        force_quantities,
        inference_quantities,
        roughness_quantities,
        scale_quantities,
    )
    for name in module.__all__
}


def estimate(quantity: str, dataset: xr.Dataset, *others: xr.Dataset) -> xr.Dataset:
    """Return a derived quantity of one dataset or several, or a variable of one.

    Parameters
    ----------
    quantity : str
        A key of `DERIVED`, a variable, or a row of Table 1: the variable that the attribute
        `table1_variables` of the dataset names.
    dataset, *others : xarray.Dataset
        What the quantity is computed from, in its order.

    Returns
    -------
    xarray.Dataset
        `value` and `value_interval`.

    Raises
    ------
    KeyError
        If a variable or an attribute that is needed does not exist.
    """
    if quantity in DERIVED:
        result: xr.Dataset = DERIVED[quantity](dataset, *others)
        return result
    rows_of_table1 = json.loads(dataset.attrs.get("table1_variables", "{}"))
    return variable_as_number(dataset, rows_of_table1.get(quantity, quantity))
