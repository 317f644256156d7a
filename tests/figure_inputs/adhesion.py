"""The inference of forces."""

import numpy as np
import xarray as xr
from paper_numbers import MEAN_FORCE

from figure_inputs.building import bounded, generator, named
from figure_inputs.forces import (
    CONTACT_MODELS,
    FINE,
    PUBLISHED_RANGE,
    PUBLISHED_WORK,
    RHO,
    least_errors,
    mean_forces,
    minima,
)

ERRORS, WORKS = least_errors(mean_forces(FINE))
MINIMA = minima(ERRORS, WORKS)  # (contact_model, 3, minimum)
RANGE, WORK, ERROR = MINIMA[1, :, 0]  # of plastic contact


def inference() -> xr.Dataset:
    """Return an inference of `mean_forces` with its error map."""
    model = "contact_model"
    work = np.geomspace(0.005, 1.0, 151)
    force, fine = mean_forces(RHO), mean_forces(FINE)
    relative = fine / MEAN_FORCE[:, None]
    error = abs(relative[..., None] * work - 1).mean(axis=1)
    ranges, works, errors = MINIMA.transpose(1, 0, 2).copy()
    at_published = force[..., RHO == PUBLISHED_RANGE][..., 0] * PUBLISHED_WORK
    at_fitted = np.stack(
        [fine[m][:, FINE == ranges[m, 0]][:, 0] * works[m, 0] for m in range(len(CONTACT_MODELS))]
    )
    paired = np.stack([at_published, at_fitted], axis=1)
    dims = (model, "pair", "surface")
    small = error[1] < 0.1
    region = FINE[small.any(axis=1)], work[small.any(axis=0)]
    ends = [[np.nan] * 2, [region[0].min(), region[0].max()]]
    work_ends = [[np.nan] * 2, [region[1].min(), region[1].max()]]
    one = {"units": "1"}
    return (
        named()
        .assign_coords(
            contact_model=CONTACT_MODELS,
            rho=RHO,
            rho_fine=FINE,
            work=work,
            pair=["published", "fitted"],
            minimum=np.arange(1, ranges.shape[-1] + 1),
        )
        .assign(
            bounded("mean_force", (model, "surface", "rho"), force, unit="N")
            | bounded("ratio", (model, "surface", "rho"), force / force[:, [1]])
            | bounded("range_from_ratios", model, [1.3, 4.9], unit="nm")
            | bounded("range_of_adhesion", model, ranges[:, 0], unit="nm")
            | bounded("work_of_adhesion", model, works[:, 0], unit="J m-2")
            | bounded("best_error", model, errors[:, 0])
            | bounded("lognormal_shape", dims, np.full((2, 2, 4), 0.5))
            | bounded("lognormal_median", dims, 0.88 * paired, unit="N")
            | bounded("force_mean", dims, paired, unit="N")
            | bounded("force_median", dims, 0.88 * paired, unit="N")
            | bounded("censored_fraction", dims, np.full((2, 2, 4), 0.1))
            | bounded("ratio_at_pair", dims, paired / paired[..., [1]])
        )
        .assign(
            mean_relative_error=((model, "rho_fine", "work"), error, one),
            error_of_range=((model, "rho_fine"), ERRORS, one),
            minimum_range=((model, "minimum"), ranges, {"units": "nm"}),
            minimum_work=((model, "minimum"), works, {"units": "J m-2"}),
            minimum_error=((model, "minimum"), errors, one),
            region_range=((model, "bound"), np.array(ends)),
            region_work=((model, "bound"), np.array(work_ends)),
            **_samples(),
        )
        .assign_attrs(error_threshold=0.1, force_floor=30e-9, confidence=0.9)
    )


def _samples() -> dict[str, tuple]:
    """Return sampled fits, of which one in four lies near the second minimum."""
    rng = generator()
    second = (rng.uniform(size=300) < 0.25).astype(int)
    ranges, works = (MINIMA[1, row][second] for row in (0, 1))
    spread = rng.lognormal(0, 0.2, 300)
    sampled = np.stack([ranges * spread] * 2), np.stack([works / spread] * 2)
    return {
        "sampled_range": (("contact_model", "sample"), sampled[0], {"units": "nm"}),
        "sampled_work": (("contact_model", "sample"), sampled[1], {"units": "J m-2"}),
    }
