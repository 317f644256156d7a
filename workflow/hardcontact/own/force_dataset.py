"""The pull-off forces on your surfaces at one work and all ranges of adhesion: force.nc.

Forces on scans come from the roughness of the scans alone. The extrapolated force also has the
roughness that the microscope does not show, but only at one range, in plastic contact. The
dimension `rho` has all ranges of adhesion (nm), the attribute `rho` that of the study.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from scipy import special

from hardcontact.base.dataset import stack
from hardcontact.base.statistics import as_variables, interval_ends, widen_interval
from hardcontact.base.units import DIMENSIONLESS, NEWTON, NM
from hardcontact.contact.contact import CONTACT_AXES, PLASTIC, Contact
from hardcontact.contact.hertz_jkr_dmt import (
    assumed_modulus,
    judge_tabor_parameter,
    limit_forces,
    smooth_pull_off,
)
from hardcontact.contact.numerical_limits import finite_scan_ratio, window_share
from hardcontact.inference.mean_forces import (
    SINGLE_CONTACT_AXES,
    MasterForces,
    MasterScans,
    SurfaceForces,
    forces_by_surface,
    half_width_over_masters,
    logarithmic_interval,
    mean_intervals,
    mean_unfiltered_force,
    position_half_width,
    summarize_masters,
)
from hardcontact.inference.scan_parts import IntervalSource
from hardcontact.own.wide_pixels import pixel_divisors
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.theory.closed_form import closed_form
from hardcontact.theory.summits import search_size

#: Quantiles of the forces of single contacts: the median, and the ends of the middle half and 90 %.
FORCE_QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]
HINDCAST_VARIABLES = [
    "hindcast_ratio", "hindcast_ratio_interval", "hindcast_fails", "wide_pixel_ratio",
]  # fmt: skip


class ForceInputs(NamedTuple):
    """The datasets of a study that force.nc needs; forces in them are at 1 J/m²."""

    adhesion: xr.Dataset
    filtered_forces: xr.Dataset
    topography: xr.Dataset
    spectra: xr.Dataset
    hindcast: xr.Dataset | None  #: None if the extrapolation is not tested.


def compute_force_dataset(
    inputs: ForceInputs,
    contact: Contact,
    master_scans: MasterScans,
    tolerance: float,
    confidence: float,
) -> xr.Dataset:
    """Return force.nc: the forces on the surfaces with their intervals, and what limits them.

    Each step adds variables to one dataset, or changes them:

    1. adhesion.nc gives ``force`` (surface, contact_model, rho), the force on scans, with its
       interval and scatter. On a rough sphere ``position_factor`` is added, too.
    2. filtered_forces.nc gives ``extrapolated_force`` (surface, side) with its interval.
    3. ``force``, ``force_interval`` and ``extrapolated_force`` give ``extrapolation_matters``.
    4. hindcast.nc, if there is one, gives HINDCAST_VARIABLES. ``hindcast_ratio`` and
       ``position_factor`` widen ``extrapolated_force_interval``. ``wide_pixel_ratio`` lowers the
       low end of ``force_interval``.
    5. The force on a smooth sphere, ``smooth_bound``, is added, and bounds both forces and
       intervals.
    6. spectra.nc gives ``search_size`` and ``weibull_modulus``.
    7. ``search_size`` and topography.nc give ``finite_scan_ratio`` and ``pixel_area``. The contact
       gives ``window_share``.
    8. adhesion.nc gives ``contacts_needed``; ``finite_scan_ratio`` and ``interval_source`` say
       where it is not known.

    Step 3 comes before step 4, because step 4 lowers ``force_interval`` by the effect of finer
    pixels. Extrapolated roughness has a similar effect, and the comparison is to show it. Step 5
    comes after step 4, because a widened interval may exceed the bound. Step 7 needs
    ``search_size`` from step 6, and step 8 ``finite_scan_ratio`` from step 7.
    """
    adhesion, filtered_forces, topography, spectra, hindcast = inputs
    scan_sizes = topography["scan_size"].to_series().to_dict()
    dataset = _forces_on_scans(adhesion, contact, scan_sizes, confidence)
    extrapolated = _forces_on_masters(filtered_forces, master_scans, contact.work, confidence)
    dataset = _add_extrapolated_forces(dataset, extrapolated, tolerance)
    if hindcast is not None:
        dataset = dataset.merge(hindcast[HINDCAST_VARIABLES], join="left")
    dataset = _widen_extrapolated_force(dataset)
    dataset = _allow_for_finer_pixels(dataset)
    dataset = _bound_by_smooth_sphere(dataset, contact.area)
    dataset = _add_closed_form(dataset, spectra, contact)
    dataset = _add_sizes(dataset, topography, contact)
    needed = _contacts_needed(adhesion["pull_off_force"], tolerance, confidence)
    return dataset.assign(contacts_needed=needed.where(_shows_other_summits(dataset)))


def _forces_on_scans(
    adhesion: xr.Dataset, contact: Contact, scan_sizes: Mapping[Any, float], confidence: float
) -> xr.Dataset:
    """Return the mean force (surface, contact_model, rho) in N over contacts and scans.

    ``force_quantile`` is over single contacts. `adhesion` is at 1 J/m², scan sizes are in nm.
    """
    adhesion_at_work = adhesion.assign(pull_off_force=adhesion.pull_off_force * contact.work)
    forces_by_model = [
        forces_by_surface(adhesion_at_work.sel(contact_model=model), scan_sizes)
        for model in adhesion.contact_model.values
    ]
    surfaces = {
        (surface,): _force_variables(
            adhesion_at_work.sel(surface=surface),
            [model_forces[surface] for model_forces in forces_by_model],
            contact.rho,
            confidence,
        )
        for surface in adhesion.surface.values.tolist()
    }
    dataset = stack(surfaces, ["surface"])
    return dataset.assign(label=adhesion.label, source=adhesion.source).assign_attrs(
        work_of_adhesion=contact.work,
        rho=contact.rho,
        confidence=confidence,
        sphere_radius=adhesion.attrs["sphere_radius"],
    )


def _force_variables(
    adhesion: xr.Dataset, forces_by_model: Sequence[SurfaceForces], rho: float, confidence: float
) -> xr.Dataset:
    """Return the variables of force.nc for one surface; `adhesion` is at the work of the study."""
    mean = np.array([forces.mean for forces in forces_by_model])
    intervals = [mean_intervals(forces, confidence) for forces in forces_by_model]
    dimensions = ("contact_model", "rho")
    quantiles = adhesion.pull_off_force.quantile(FORCE_QUANTILES, SINGLE_CONTACT_AXES).transpose(
        *dimensions, "quantile"
    )
    log_force_std = np.array([forces.log_force_std for forces in forces_by_model])
    contact_count = np.prod([adhesion.sizes[axis] for axis in CONTACT_AXES])
    # All contact models have the same parts.
    scan_parts = forces_by_model[0].scan_parts[np.abs(adhesion.rho.values - rho).argmin()]
    variables = as_variables("force", dimensions, mean, np.array(intervals), NEWTON, confidence)
    half_widths = [position_half_width(forces, confidence) for forces in forces_by_model]
    if half_widths[0] is not None:  # The sphere is rough, and its position is not known.
        factor = np.exp(np.array(half_widths))
        variables["position_factor"] = (dimensions, factor, DIMENSIONLESS)
    return xr.Dataset(
        variables
        | {
            "force_quantile": ((*dimensions, "quantile"), quantiles.values, NEWTON),
            "log_force_std": (dimensions, log_force_std, DIMENSIONLESS),
            "interval_source": scan_parts.interval_source,
            "interval_scans": scan_parts.scan_count,
            "contacts": ((), contact_count, DIMENSIONLESS),
            "touched_patches": ((), scan_parts.touched_patches, DIMENSIONLESS),
            "correlation_of_parts": ((), scan_parts.mean_correlation, DIMENSIONLESS),
        },
        {name: adhesion[name] for name in dimensions}
        | {"quantile": ("quantile", FORCE_QUANTILES, DIMENSIONLESS)},
    )


def _forces_on_masters(
    filtered_forces: xr.Dataset, master_scans: MasterScans, work: float, confidence: float
) -> xr.Dataset:
    """Return the mean force (surface, side) in N on unfiltered masters, from forces at 1 J/m².

    Masters are scans with artificial roughness, from the ``transition`` to the
    ``extrapolation_end``, both in nm. The force is the mean over contacts and masters.
    """

    def summary(master_forces: MasterForces) -> xr.Dataset:
        """Return the extrapolated force of one surface and side."""
        force = work * master_forces.forces.unfiltered_pull_off_force.mean().values
        shifts = master_forces.forces.get("log_unfiltered_force_shift")
        half_width = half_width_over_masters(
            master_forces, mean_unfiltered_force, shifts, confidence
        )
        interval = logarithmic_interval(force, half_width)
        return xr.Dataset(
            as_variables("extrapolated_force", (), force, interval, NEWTON, confidence)
            | {
                "extrapolated_force_interval_source": master_forces.scan_parts.interval_source,
                "extrapolation_end": ((), float(master_forces.forces.spectrum_end), NM),
            }
        )

    transition = filtered_forces["transition"]
    return summarize_masters(filtered_forces, master_scans, summary).assign(transition=transition)


def _add_extrapolated_forces(
    dataset: xr.Dataset, extrapolated_forces: xr.Dataset, tolerance: float
) -> xr.Dataset:
    """Return the dataset with extrapolated forces, and with whether the extrapolation matters.

    It matters if the extrapolated force is outside the interval of the force on the scans, and
    differs from this force by more than the tolerance.
    """
    on_scans = _plastic_at_range(dataset, dataset.attrs["rho"])
    extrapolated = extrapolated_forces["extrapolated_force"]
    low, high = interval_ends(on_scans, "force")
    is_inside = (low <= extrapolated) & (extrapolated <= high)
    is_changed = np.abs(extrapolated / on_scans["force"] - 1) > tolerance
    matters = (is_changed & ~is_inside).astype(int)
    matters.attrs = DIMENSIONLESS
    return dataset.merge(extrapolated_forces).assign(
        extrapolation_matters=matters.transpose("surface", "side")
    )


def _plastic_at_range(data: Any, rho: float) -> Any:
    """Return a dataset or array for plastic contact, at the computed range nearest to rho (nm)."""
    return data.sel(contact_model=PLASTIC, drop=True).sel(rho=rho, method="nearest", drop=True)


def _widen_extrapolated_force(dataset: xr.Dataset) -> xr.Dataset:
    """Return the dataset with a wider interval of the extrapolated force, by up to two errors.

    The unknown position of a rough sphere, which the interval of the force on scans already
    includes, and the error that the hindcast shows, widen it to either side.
    """
    if "position_factor" in dataset:
        factor = _plastic_at_range(dataset, dataset.attrs["rho"])["position_factor"]
        dataset = widen_interval(dataset, "extrapolated_force", factor)
    if "hindcast_ratio" in dataset:
        dataset = widen_interval(dataset, "extrapolated_force", dataset["hindcast_ratio"])
    return dataset


def _allow_for_finer_pixels(dataset: xr.Dataset) -> xr.Dataset:
    """Return the dataset with a lower low end of ``force_interval``.

    Finer pixels would lower forces, not raise them (`own.wide_pixels`).
    """
    interval = dataset["force_interval"]
    lowered = interval / pixel_divisors(dataset)
    interval = interval.where(interval["end"] != "low", lowered).transpose(*interval.dims)
    return dataset.assign(force_interval=interval)


def _bound_by_smooth_sphere(dataset: xr.Dataset, area: float) -> xr.Dataset:
    """Return the dataset with forces and intervals that never exceed that on a smooth sphere.

    The contact `area` is in nm². Proof: workflow/report/theory.md (Upper bound of the force).
    """
    # Rigid contact has no area.
    areas = area * (dataset["contact_model"] == PLASTIC)
    work = dataset.attrs["work_of_adhesion"]
    radius = dataset.attrs["sphere_radius"]
    bound = smooth_pull_off(work, radius, areas, dataset["rho"])
    master_bound = _plastic_at_range(bound, dataset.attrs["rho"])
    bounded = {"smooth_bound": bound.assign_attrs(NEWTON)}
    for force, limit in {"force": bound, "extrapolated_force": master_bound}.items():
        for name in (force, f"{force}_interval"):
            bounded[name] = xr.apply_ufunc(limit_forces, dataset[name], limit, keep_attrs=True)
    return dataset.assign(bounded)


def _add_closed_form(dataset: xr.Dataset, spectra: xr.Dataset, contact: Contact) -> xr.Dataset:
    """Return the dataset with search size (nm), Weibull modulus (surface) and Tabor parameter."""
    surfaces = dataset["surface"].values
    own_spectra = [spectrum_of_dataset(spectra.sel(surface=surface)) for surface in surfaces]
    search_sizes = [search_size(spectrum, contact.radius, contact.area) for spectrum in own_spectra]
    moduli = [closed_form(spectrum, contact).weibull_modulus for spectrum in own_spectra]
    tabor = judge_tabor_parameter(contact, assumed_modulus(contact.hardness))
    return dataset.assign(
        search_size=("surface", search_sizes, NM),
        weibull_modulus=("surface", moduli, DIMENSIONLESS),
    ).assign_attrs(tabor_parameter=tabor.value, bodies=tabor.status)


def _add_sizes(dataset: xr.Dataset, topography: xr.Dataset, contact: Contact) -> xr.Dataset:
    """Return the dataset with the effects of scan width and window, and the pixel area in nm²."""
    scans = topography[["scan_size", "pixel_size"]].sel(surface=dataset["surface"])
    sizes = zip(scans["scan_size"].values, dataset["search_size"].values, strict=True)
    ratios = [finite_scan_ratio(*scan_and_search_size) for scan_and_search_size in sizes]
    return dataset.assign(
        finite_scan_ratio=(("surface", "end"), ratios, DIMENSIONLESS),
        pixel_area=("surface", scans["pixel_size"].values ** 2, {"units": "nm2"}),
        window_share=("rho", window_share(contact, dataset["rho"].values), DIMENSIONLESS),
    ).assign_attrs(window=contact.window, contact_area=contact.area)


def _contacts_needed(forces: xr.DataArray, tolerance: float, confidence: float) -> xr.DataArray:
    """Return the number of contacts whose mean force is within the tolerance, with a confidence.

    If each contact meets other summits, a mean over that many contacts has the half width
    quantile * relative_std / sqrt(count), which is the tolerance. At least one contact is needed.
    """
    relative_std = forces.std(SINGLE_CONTACT_AXES) / forces.mean(SINGLE_CONTACT_AXES)
    quantile = float(special.ndtri((1 + confidence) / 2))
    count = (quantile / tolerance * relative_std) ** 2
    return count.clip(min=1).assign_attrs(DIMENSIONLESS)


def _shows_other_summits(dataset: xr.Dataset) -> xr.DataArray:
    """Return whether scans (surface) show how the forces of contacts on other summits differ.

    On a small scan, or on few patches, all contacts find the same summits.
    """
    is_large = dataset["finite_scan_ratio"].max("end") <= 1
    return is_large & (dataset["interval_source"] != IntervalSource.FEW_PATCHES)
