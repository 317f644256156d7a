"""Experiments beside the law: of every statement one, others that test less, and controls."""

from functools import cache

import xarray as xr
from known_experiments import experiment

from hardcontact.claims.weighed_experiments import weighed


def ledger() -> xr.Dataset:
    """Return what four draws say of each of them."""
    return _computed().copy(deep=True)


@cache
def _computed() -> xr.Dataset:
    return weighed(
        [
            experiment("fall", id="fall", rough=10.0, range_nm=(1.0, 5.0)),
            experiment("ratio_to_smooth", id="ratio", range_nm=(1.0, 5.0)),
            experiment("exponent_in_radius", id="exponent", radius_nm=(1e4, 1e5)),
            experiment("contact_distance", id="distance", range_nm=(1.0, 5.0)),
            experiment("ratio_to_smooth", id="tip", radius_nm=1e3),
            experiment("ratio_to_smooth", id="soft", contact="soft", rule="above", low=0.99),
            experiment("ratio_to_smooth", id="capped", contact="soft", rule="above", low=1.0),
            experiment("ratio_to_smooth", id="lacking", measured=float("nan")),
        ],
        draws=4,
        seed=1,
        confidence=0.95,
    )
