"""Heights of the sphere's apex above the mean planes, inferred from pull-off forces.

The apex is at the height m above the mean plane of Gaussian roughness of the rms height sigma. By
Eq. 2 all points below the sphere attract together with the force

    F = 2 pi R W exp(sigma²/2 rho² - m/rho) Phi(m/sigma - sigma/rho).

A force therefore gives m for every rho and W. If only few points carry
the force, the formula underestimates it. Published forces are therefore compared with computed
forces by the same formula.
"""

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact.base.units import NM
from hardcontact.contact.smooth_sphere import dmt_pull_off
from hardcontact.inference import error_map
from hardcontact.surfaces.spectrum import Floats
from hardcontact.theory.closed_form import gaussian_share

#: Number of tabulated heights of the apex. The highest one is MAX_HEIGHT_IN_RMS_HEIGHTS rms
#: heights plus MAX_HEIGHT_IN_RANGES ranges of adhesion.
HEIGHT_COUNT = 20001
MAX_HEIGHT_IN_RMS_HEIGHTS = 10
MAX_HEIGHT_IN_RANGES = 40
#: Statistics of the forces on a surface that give a height.
STATISTICS = ["mean", "median"]
#: Work of adhesion: the published work, or the work that fits all forces best at each range.
WORK_SOURCES = ["published", "fitted"]


def apex_height(relative_force: Floats, rms_height: float, rho: float) -> Floats:
    """Return the height m of the apex that gives a force.

    The force has a maximum at some height: lower down, fewer points lie below the sphere. Only
    heights above that of the maximum are searched.

    relative_force: force (...) relative to 2 pi R W.
    rms_height, rho: rms height and range of adhesion in nm.
    Returns heights (...) in nm, NaN if every height gives a smaller force.
    """
    highest = MAX_HEIGHT_IN_RMS_HEIGHTS * rms_height + MAX_HEIGHT_IN_RANGES * rho
    heights = np.linspace(0, highest, HEIGHT_COUNT)
    tabulated_forces = gaussian_share(rms_height, heights, rho)
    falling = slice(tabulated_forces.argmax(), None)
    minus_log_force = -np.log(tabulated_forces[falling])
    return np.interp(-np.log(relative_force), minus_log_force, heights[falling], np.nan, np.nan)


def infer_apex_heights(
    adhesion: xr.Dataset, published_forces: pd.DataFrame, work: float, rms_heights: pd.Series
) -> xr.Dataset:
    """Infer the height of the apex from published and from computed forces.

    adhesion: adhesion.nc for one contact model.
    published_forces: ``mean_force`` and ``median_force`` in N by surface.
    work: the published work of adhesion in J/m².
    rms_heights: root of the sum of the squared rms heights of substrate and sphere in nm, by
        surface.
    Returns ``height_from_computed`` (surface, statistic, rho) in nm follows from computed forces
        and does not depend on W. ``height_from_published`` (surface, statistic, work_source, rho)
        in nm follows from published forces. ``combined_rms_height`` (surface) is in nm.
    """
    forces = adhesion["pull_off_force"].stack(
        contact=["scan", "sphere_scan", "contact_y", "contact_x"]
    )
    computed_forces = xr.concat([forces.mean("contact"), forces.median("contact")], "statistic")
    computed_forces = computed_forces.transpose("surface", "statistic", "rho")
    surfaces = computed_forces["surface"].values
    ranges = computed_forces["rho"].values
    columns = [f"{name}_force" for name in STATISTICS]
    force_values = published_forces.loc[surfaces, columns].to_numpy()
    fitted_work, _ = error_map.fit_work(
        computed_forces.isel(statistic=0).values, force_values[:, 0]
    )
    smooth_force = float(dmt_pull_off(1.0, adhesion.attrs["sphere_radius"]))
    works = np.stack([np.full(ranges.size, work), fitted_work])
    height_from_published = np.empty(
        (surfaces.size, len(STATISTICS), len(WORK_SOURCES), ranges.size)
    )
    height_from_computed = np.empty(computed_forces.shape)
    for i, surface in enumerate(surfaces):
        for k, rho in enumerate(ranges):
            rms_height = rms_heights[surface]
            published_ratios = force_values[i, :, None] / (smooth_force * works[:, k])
            height_from_published[i, :, :, k] = apex_height(published_ratios, rms_height, rho)
            computed_ratios = computed_forces.values[i, :, k] / smooth_force
            height_from_computed[i, :, k] = apex_height(computed_ratios, rms_height, rho)
    return xr.Dataset(
        {
            "height_from_published": (
                ("surface", "statistic", "work_source", "rho"),
                height_from_published,
                NM,
            ),
            "height_from_computed": (("surface", "statistic", "rho"), height_from_computed, NM),
            "combined_rms_height": ("surface", rms_heights[surfaces].to_numpy(), NM),
        },
        {
            "statistic": STATISTICS,
            "work_source": WORK_SOURCES,
            "rho": computed_forces["rho"],
        },
    ).assign(adhesion[["label", "basis"]])
