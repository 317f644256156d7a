"""The functions for programs, which ``import hardcontact as hc`` gives.

They compute as the study and its commands do. Lengths and heights are in nm, wavevectors in rad/nm,
forces in N, works of adhesion in J/m², pressures in Pa. All raise ValueError with one line for each
fault of their input. They warn of unusual quantities of a contact, because the unit may be wrong.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from hardcontact.base.dataset import stack
from hardcontact.base.number import Number
from hardcontact.base.units import DIMENSIONLESS, NEWTON
from hardcontact.config.arguments import (
    arguments_in_messages,
    check_contact,
    check_cutoffs,
    check_heights,
    check_positive,
    check_positive_numbers,
    check_quantities,
    check_read_arguments,
    make_periodic,
)
from hardcontact.config.faults import raise_faults
from hardcontact.config.keys import NONE, ContactKeys, IntervalKeys, ScalesKeys
from hardcontact.contact.contact import PLASTIC, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import WORK_OF_ADHESION, pull_off_dataset
from hardcontact.contact.scan_pull_off import wider_window_change
from hardcontact.inference.edges import edges_of_ratios
from hardcontact.inference.filtered_masters import Filters, add_force_ratios, filtered_pull_off
from hardcontact.own.own_spectrum import OwnSpectrum, read_own_spectrum, spectrum_of_map
from hardcontact.own.scan_force import prediction_and_scan_force
from hardcontact.scans import reading
from hardcontact.scans.heights import RefusedFile, map_fields, unit_in_nm
from hardcontact.scans.joined_spectrum import ScanSpectrum
from hardcontact.surfaces.height_map import HeightMap, refuse_line_scan
from hardcontact.surfaces.levelling import remove_form
from hardcontact.surfaces.metrics import metrics as metrics
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.spectrum import measured_psds as measured_psds
from hardcontact.theory.validity import wide_contact_message

if TYPE_CHECKING:
    from SurfaceTopography import Topography

# Defaults of the arguments.
PAPER_CONTACT = ContactKeys()
PAPER_TOLERANCE = ScalesKeys().tolerance
PAPER_CONFIDENCE = IntervalKeys().confidence


def read_scan(
    path: str | Path,
    dataset: str = "",
    *,
    undefined_pixels: str = "refuse",
    unit: str = NONE,
    map_size: float | str = NONE,
    mask: str = "keep",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> HeightMap:
    """Read a height map as the study prepares it: its central square, levelled.

    Parameters
    ----------
    path : str or Path
        Any format that SurfaceTopography reads, or a container of scans.
    dataset : str
        Scan of a container, or channel of any other file; empty for the file's choice.
    undefined_pixels : str
        ``"refuse"`` a scan with undefined pixels, or fill them with a ``"harmonic"`` function.
    unit, map_size : str, float or str
        For a file that states none: a unit such as ``"nm"``, or ``"mm,nm"`` for positions and
        heights; the longer side in nm.
    mask : str
        ``"keep"`` or ``"exclude"`` the heights under a mask in a file of Gwyddion.
    levelling : str
        ``"plane"``; ``"lines"``, which fills streaks and aligns lines first; or ``"quadratic"``,
        which also subtracts the bow of a scanner.
    sphere_radius : float or None
        Radius in nm of the sphere that the scan shows, which is subtracted; None for a flat
        surface.

    Returns
    -------
    HeightMap
        ``heights`` (y, x) in nm, in float32, and ``pixel_size`` in nm.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    """
    lengths = {"map_size": map_size, "sphere_radius": sphere_radius}
    check_read_arguments(
        [path], lengths, dataset=dataset, unit=unit, undefined_pixels=undefined_pixels, mask=mask
    )
    with arguments_in_messages():
        scan = reading.read_scan(path, dataset, undefined_pixels, unit, map_size, mask)
        refuse_line_scan(scan)
    return _level(scan, sphere_radius, levelling)


def from_topography(
    topography: "Topography",
    *,
    undefined_pixels: str = "refuse",
    levelling: str = "plane",
    sphere_radius: float | None = None,
) -> HeightMap:
    """Return a levelled height map from SurfaceTopography, as `read_scan` does from a file.

    Parameters
    ----------
    topography : SurfaceTopography.Topography
        A map with physical sizes and a unit of length.
    undefined_pixels, levelling, sphere_radius : str, str, float or None
        As for `read_scan`.

    Returns
    -------
    HeightMap
        As of `read_scan`.

    Examples
    --------
    >>> from SurfaceTopography import Topography
    >>> heights = np.random.default_rng(1).normal(size=(64, 64))  # first axis x
    >>> scan = hc.from_topography(Topography(heights, (640, 640), unit="nm"))
    """
    if getattr(topography, "dim", None) != 2 or not isinstance(topography.unit, str):
        raise ValueError(
            "topography: expected a map of SurfaceTopography with a unit of length, found "
            f"{type(topography).__name__}"
        )
    check_read_arguments([], {"sphere_radius": sphere_radius})
    with arguments_in_messages():
        try:
            fields = map_fields(topography, unit_in_nm(topography.unit), undefined_pixels)
        except RefusedFile as error:
            raise ValueError(f"topography: {error}") from None
    return _level(HeightMap(fields["heights"], fields["pixel_size"]), sphere_radius, levelling)


def _level(scan: HeightMap, sphere_radius: float | None, levelling: str) -> HeightMap:
    """Return a levelled height map in float32, like the study's files."""
    flat = remove_form(scan, sphere_radius, levelling)
    return replace(flat, heights=flat.heights.astype(np.float32))


def read_spectrum(
    *files: str | Path,
    dataset: str = "",
    tip_radius: float | None = None,
    undefined_pixels: str = "harmonic",
    unit: str = NONE,
    map_size: float | str = NONE,
    mask: str = "keep",
    levelling: str = "plane",
    sphere_radius: float | None = None,
    extrapolated: bool = False,
) -> Spectrum:
    """Return C_iso of one surface from a table, or joined from the spectra of scans.

    Parameters
    ----------
    *files : str or Path
        One table of a spectrum, described by ``hardcontact predict --help``; or height maps, line
        scans and containers.
    dataset : str
        Name of the only scan in a container to read; empty: all scans.
    tip_radius : float or None
        Radius of the tip in nm for scans whose files do not state it.
    undefined_pixels, unit, map_size, mask, levelling, sphere_radius : str, float or None
        As for `read_scan`.
    extrapolated : bool
        Whether the spectrum of scans is extrapolated beyond their reliable wavelengths, as a study
        does: to long waves up to a roll-off, to short waves as self-affine.

    Returns
    -------
    Spectrum
        ``wavevector`` in rad/nm and ``density`` in nm⁴.

    Examples
    --------
    >>> shortest = hc.read_spectrum("scan.nc").wavelength[-1]  # nm
    """
    lengths = {"map_size": map_size, "tip_radius": tip_radius, "sphere_radius": sphere_radius}
    check_read_arguments(
        files, lengths, dataset=dataset, unit=unit, undefined_pixels=undefined_pixels, mask=mask
    )
    options = reading.ReadingOptions(tip_radius, unit, map_size, levelling, mask, undefined_pixels)
    with arguments_in_messages():
        surface = read_own_spectrum(files, options, dataset=dataset, sphere_radius=sphere_radius)
    spectrum = surface.spectrum
    if extrapolated and isinstance(spectrum, ScanSpectrum):
        return spectrum.extrapolated()
    return spectrum


def pull_off_forces(
    scan: HeightMap,
    *,
    radius: float,
    preload: float,
    hardness: float,
    rho: float | Sequence[float],
    work: float,
    window: float = PAPER_CONTACT.window,
    contacts_per_row: int = PAPER_CONTACT.contacts_per_row,
    sphere: HeightMap | None = None,
) -> xr.Dataset:
    """Return the pull-off forces of a sphere at an array of contacts on a scan, Eq. 3 of the paper.

    Parameters
    ----------
    scan : HeightMap
        The levelled scan; if it is not periodic, it is mirrored.
    radius, preload, hardness : float
        Radius of the sphere in nm, load on a contact in N, hardness of the softer body in Pa.
    rho, work : float or sequence of float, float
        One or several ranges of adhesion in nm; work of adhesion in J/m².
    window, contacts_per_row : float, int
        Width in nm of the square around a contact in which attraction is summed; contacts per row
        of the square array.
    sphere : HeightMap or None
        Levelled roughness of the sphere where it touches; None for a smooth sphere.

    Returns
    -------
    xarray.Dataset
        - ``pull_off_force`` (contact_model, rho, contact_y, contact_x) in N, rigid and plastic.
        - ``apex_height`` in nm, of the sphere above the mean plane at closest approach.
        - ``touched_patches``, the number of patches that contacts touch.
        - ``wider_window_change``, the relative change of forces at the longest range if the window
          is wider by a period of the map on each side.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> forces = hc.pull_off_forces(
    ...     scan, radius=50e3, preload=10e-6, hardness=25e9, rho=5.6, work=0.05,
    ...     window=2500, contacts_per_row=8,
    ... )
    >>> mean = forces.pull_off_force.sel(contact_model="plastic").mean()  # N
    """
    quantities: dict[str, Any] = {"radius": radius, "preload": preload, "hardness": hardness}
    check_quantities(**quantities, work=work)
    contact = Contact(**quantities, window=window, contacts_per_row=contacts_per_row)
    ranges = [rho] if isinstance(rho, int | float) else rho
    check_positive_numbers("rho", ranges)
    surface, rough_sphere = _periodic_maps(scan, sphere, contact, ranges)
    bodies = join_bodies(surface, rough_sphere, contact)
    longest = replace(contact, rho=max(ranges))
    forces = pull_off_dataset(bodies, contact, ranges)
    plastic_forces = forces.pull_off_force.sel(contact_model=[PLASTIC], rho=longest.rho)
    window_change = wider_window_change([bodies], longest, plastic_forces)
    force = forces.pull_off_force * (work / WORK_OF_ADHESION)
    force.attrs = NEWTON | {"long_name": "pull-off force"}
    variables = {"pull_off_force": force, "wider_window_change": ((), window_change, DIMENSIONLESS)}
    return forces.assign(variables).assign_attrs(work_of_adhesion=work)


def _periodic_maps(
    scan: HeightMap, sphere: HeightMap | None, contact: Contact, ranges: Sequence[float]
) -> tuple[HeightMap, HeightMap | None]:
    """Return the mirrored maps of both bodies; refuse a contact on them beyond the limits."""
    surface = make_periodic(scan)
    rough_sphere = None if sphere is None else make_periodic(sphere, "sphere")
    check_contact(surface, contact, ranges)
    return surface, rough_sphere


def force_ratios(
    scan: HeightMap,
    cutoffs: Mapping[str, Sequence[float]],
    *,
    radius: float,
    preload: float,
    hardness: float,
    rho: float,
    tolerance: float = PAPER_TOLERANCE,
    window: float = PAPER_CONTACT.window,
    contacts_per_row: int = PAPER_CONTACT.contacts_per_row,
    sphere: HeightMap | None = None,
) -> xr.Dataset:
    """Return forces without the roughness beyond cutoffs, relative to the force on the whole scan.

    The edges are those of the scan alone, whereas a study adds extrapolated roughness.

    Parameters
    ----------
    scan : HeightMap
        As for `pull_off_forces`.
    cutoffs : mapping of str to sequence of float
        Wavelengths in nm of more than two pixels, on the side ``"short"``, which removes shorter
        wavelengths, the side ``"long"``, which removes longer ones, or both.
    rho, tolerance : float
        Range of adhesion in nm; relative change of the force that defines an edge.
    radius, preload, hardness, window, contacts_per_row, sphere : float, int, HeightMap or None
        As for `pull_off_forces`.

    Returns
    -------
    xarray.Dataset
        - ``edge`` (side) in nm, the cutoff at which the force leaves its tolerance.
        - ``edge_status`` (side): ``"found"``; ``"open_above"`` or ``"open_below"`` if the edge lies
          above or below ``edge_bound`` (side) in nm; ``"ripples"`` if ripples of the filter at
          steps, not roughness, change the force.
        - ``filtered_force_ratio`` (side, cutoff_wavelength), the mean plastic force relative to the
          force on the unfiltered scan; NaN at cutoffs of the other side.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> ratios = hc.force_ratios(
    ...     scan, {"short": [40, 80, 160]}, radius=50e3, preload=10e-6, hardness=25e9, rho=5.6,
    ...     window=2500, contacts_per_row=8,
    ... )
    >>> short_edge = float(ratios.edge.sel(side="short"))  # nm
    """
    quantities: dict[str, Any] = {"radius": radius, "preload": preload, "hardness": hardness}
    check_quantities(**quantities, rho=rho)
    check_positive(tolerance=tolerance)
    contact = Contact(**quantities, rho=rho, window=window, contacts_per_row=contacts_per_row)
    surface, rough_sphere = _periodic_maps(scan, sphere, contact, [rho])
    check_cutoffs(cutoffs, surface)
    forces = {}
    for side, side_cutoffs in cutoffs.items():
        wavelengths = sorted({float(wavelength) for wavelength in side_cutoffs})
        filters = Filters(side, surface.pixels, wavelengths)
        side_forces = filtered_pull_off(surface, filters, [contact], rough_sphere)
        forces[(side,)] = side_forces.isel(radius=0, loading=0, rho=0, drop=True)
    ratios = add_force_ratios(stack(forces, ["side"]))[["filtered_force_ratio"]]
    edges = edges_of_ratios(ratios, tolerance)[["edge", "edge_status", "edge_bound"]]
    return edges.assign(ratios).assign_attrs(rho=rho, tolerance=tolerance)


def predict(
    roughness: Spectrum | HeightMap,
    *,
    radius: float,
    preload: float,
    hardness: float,
    rho: float,
    work: float,
    tolerance: float = PAPER_TOLERANCE,
) -> dict[str, Number]:
    """Predict the force of a smooth sphere from a spectrum, or from a map on which it is computed.

    Parameters
    ----------
    roughness : Spectrum or HeightMap
        C_iso in nm⁴ over growing wavevectors in rad/nm, without gaps; or a levelled map, whose
        spectrum is measured at its reliable wavelengths.
    radius, preload, hardness, work, rho, tolerance : float
        As for `pull_off_forces` and `force_ratios`.

    Returns
    -------
    dict of str to Number
        Numbers of ``hardcontact predict --json``, each with ``value``, ``unit``, ``low`` and
        ``high`` of its interval, and ``status``. Forces are in N, lengths in nm.

        - Force in closed form: ``closed_form_force``, ``force_over_smooth`` (relative to
          ``smooth_force``). The status ``"outside"``, also of an edge, means an unknown error,
          ``"steep_sidewalls"`` that the heights are not Gaussian, so that there is no value.
        - Band: ``short_edge``, ``long_edge``, for the change ``tolerance`` of the force.
        - Roughness beyond the spectrum: ``extrapolated_change``, the relative change of the force.
          If its status is ``"matters"``, use ``extrapolated_force``, ``extrapolated_short_edge``
          and ``extrapolated_long_edge``. ``extrapolated_to`` is the shortest wavelength of this
          spectrum; it also has ``extrapolated_rolloff`` and ``extrapolated_hurst``.
        - Contact: ``apex_height``, of the sphere above the mean plane; ``weibull_modulus``, above 1
          if many points carry the force, below 1 if single peaks do.
        - Spectrum: ``rms_height``, ``rms_gradient``, ``shortest_wavelength``,
          ``longest_wavelength``.
        - Checks whether the error is known: ``longest_octave_change``, ``widest_gap``,
          ``skewness``, ``validated_...``.

        For a map also:

        - Force on its pixels: ``force_on_scan``, ``force_on_scan_over_smooth``, and
          ``log_force_std``, the standard deviation of ln F over contacts. If the map is too large,
          or `rho` below ``shortest_range``, the force has no value, and the numbers below are
          missing.
        - ``closed_form_on_scan``, for all waves of the map. Unless its status is ``"agrees"``, no
          number of the closed form has an interval.
        - Size: ``wide_pixel_ratio``, the force on pixels four times wider relative to the map;
          ``touched_patches``; ``search_size``, the width of the square in which the sphere finds
          the summits that it touches.

    Examples
    --------
    >>> spectrum = hc.read_spectrum("scan.nc")
    >>> numbers = hc.predict(
    ...     spectrum, radius=250e3, preload=10e-6, hardness=25e9, rho=5.6, work=0.0463
    ... )
    >>> force = numbers["closed_form_force"].value  # N
    """
    quantities: dict[str, Any] = {"radius": radius, "preload": preload, "hardness": hardness}
    check_quantities(**quantities, rho=rho, work=work)
    check_positive(tolerance=tolerance)
    if isinstance(roughness, HeightMap):
        check_heights(roughness.heights, "roughness")
        heights = roughness.heights.astype(float)
        own_spectrum = spectrum_of_map(HeightMap(heights, roughness.pixel_size, path="roughness"))
    elif isinstance(roughness, Spectrum):
        own_spectrum = OwnSpectrum(roughness, ())
    else:
        raise ValueError(
            "roughness: expected a scan of hc.read_scan(FILE), or a spectrum of "
            f"hc.read_spectrum(FILE), found {type(roughness).__name__}"
        )
    contacts_per_row = PAPER_CONTACT.contacts_per_row
    contact = Contact(**quantities, rho=rho, work=work, contacts_per_row=contacts_per_row)
    raise_faults(filter(None, [wide_contact_message(contact)]))
    return prediction_and_scan_force(own_spectrum, contact, tolerance, PAPER_CONFIDENCE)
