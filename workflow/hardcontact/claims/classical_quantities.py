"""Numbers about classical models and effective works of adhesion.

Each function returns a number as `numbers.number` does; in brackets its dimensions.
"""

import xarray as xr

from hardcontact.claims.numbers import decades, quotient, variable_as_number

__all__ = ["classical_over_numerical", "effective_work_decades"]


def effective_work_decades(classical: xr.Dataset) -> xr.Dataset:
    """Return the decades between effective works of adhesion of the surfaces (against, tabor)."""
    return decades(variable_as_number(classical, "effective_work_of_adhesion"), "surface")


def classical_over_numerical(classical: xr.Dataset, inference: xr.Dataset) -> xr.Dataset:
    """Return the least error of a classical model over that of the force sum.

    Over metrics, model, against and contact_model.
    """
    return quotient(
        variable_as_number(classical, "mean_relative_error"),
        variable_as_number(inference, "best_error"),
    )
