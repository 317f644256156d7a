"""The functions for programs, which ``import hardcontact as hc`` gives.

They compute as the study and its commands do. Lengths and heights are in nm, wavevectors in rad/nm,
forces in N, works of adhesion in J/m², pressures in Pa. Each function raises ValueError if its
input is invalid, with one line for each fault; only `metrics` and `measured_psds` do not check
their map. Functions of a contact warn if one of its quantities is unusual, because the unit may be
wrong. `read_spectrum` warns of what may be wrong with its scans.
"""

import warnings
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
    check_positive_numbers,
    check_quantities,
    check_read_arguments,
    check_tolerance,
    make_periodic,
)
from hardcontact.config.faults import raise_faults
from hardcontact.config.keys import NONE, BandKeys, ContactKeys, IntervalKeys
from hardcontact.contact.contact import PLASTIC, Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import WORK_OF_ADHESION, pull_off_dataset, wider_window_change
from hardcontact.inference.edges import edges_of_ratios
from hardcontact.inference.forces_on_masters import Filters, add_force_ratios, filtered_pull_off
from hardcontact.own.own_spectrum import OwnSpectrum, read_own_spectrum, spectrum_of_map
from hardcontact.own.scan_force import prediction_and_scan_force
from hardcontact.scans import reading
from hardcontact.scans.heights import RefusedFile, map_fields, split_notes, unit_in_nm
from hardcontact.scans.joined_spectrum import ScanSpectrum
from hardcontact.surfaces.height_map import HeightMap, refuse_line_scan
from hardcontact.surfaces.levelling import remove_form
from hardcontact.surfaces.metrics import metrics as metrics
from hardcontact.surfaces.spectrum import Spectrum
from hardcontact.surfaces.spectrum import measured_psds as measured_psds
from hardcontact.theory.closed_form import wide_contact_message

if TYPE_CHECKING:
    from SurfaceTopography import Topography

# Defaults of the arguments.
PAPER_CONTACT = ContactKeys()
PAPER_TOLERANCE = BandKeys().tolerance
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
    """Read a height map as the study prepares it: cropped to a square and levelled.

    Parameters
    ----------
    path : str or Path
        The file of the scan, in any format that SurfaceTopography reads, or a container of scans.
    dataset : str
        Name of the scan in a container, or name or number (from 1) of the channel in any other
        file. If it is empty, the file's default channel is read. A container needs a name.
    undefined_pixels : str
        ``"refuse"`` raises ValueError if pixels are undefined. ``"harmonic"`` fills them with a
        harmonic function.
    unit : str
        Unit of length if the file states none, such as ``"nm"``. ``"mm,nm"`` is a unit for
        positions and another one for heights. ``"none"`` means that the file states the unit.
    map_size : float or "none"
        Longer side of the map in nm. ``"none"`` means that the file states it.
    mask : str
        Whether to ``"keep"`` or to ``"exclude"`` the heights under a mask in a file of Gwyddion.
    levelling : str
        ``"plane"`` subtracts a plane. ``"lines"`` first fills streaks and aligns lines.
        ``"quadratic"`` subtracts the bow of a scanner, too.
    sphere_radius : float or None
        Radius in nm of the sphere that the scan shows. The sphere is subtracted. None stands for a
        flat surface.

    Returns
    -------
    HeightMap
        Its ``heights`` (y, x) are in nm, in single precision; its ``pixel_size`` is in nm.

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
    """Return the levelled height map of an object of SurfaceTopography.

    The function prepares the map as `read_scan` prepares the map of a file.

    Parameters
    ----------
    topography : SurfaceTopography.Topography
        A map that has physical sizes and a unit of length.
    undefined_pixels, levelling, sphere_radius : str, str, float or None
        As for `read_scan`.

    Returns
    -------
    HeightMap
        The same as `read_scan` returns.

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
    check_read_arguments([], {"sphere_radius": sphere_radius}, undefined_pixels=undefined_pixels)
    with arguments_in_messages():
        try:
            fields = map_fields(topography, unit_in_nm(topography.unit), undefined_pixels)
        except RefusedFile as error:
            raise ValueError(f"topography: {error}") from None
    return _level(HeightMap(fields["heights"], fields["pixel_size"]), sphere_radius, levelling)


def _level(scan: HeightMap, sphere_radius: float | None, levelling: str) -> HeightMap:
    """Return a levelled height map without its sphere, in float32 like the study's files."""
    levelled = remove_form(scan, sphere_radius, levelling)
    return replace(levelled, heights=levelled.heights.astype(np.float32))


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
    """Return the spectrum C_iso of one surface, from a table or from scans.

    The spectra of several scans are joined at their reliable wavelengths. The function warns of
    filled pixels, and of each caution that ``hardcontact predict`` prints on the files.

    Parameters
    ----------
    *files : str or Path
        Either one table of a spectrum, as ``hardcontact predict --help`` describes it, or height
        maps, line scans and containers.
    dataset : str
        Name of the scan to read in a container, or of the channel in any other file. If it is
        empty, all scans of a container are read.
    tip_radius : float or None
        Radius of the tip in nm if the files do not state it. None stands for an unknown radius.
    undefined_pixels, unit, map_size, mask, levelling, sphere_radius : str, float or None
        As for `read_scan`. By default undefined pixels are filled, as by ``hardcontact predict``.
    extrapolated : bool
        Whether to extrapolate the spectrum of scans beyond their reliable wavelengths, as a study
        does. Long waves are added up to a roll-off, short waves with the Hurst exponent of the
        shortest reliable decade.

    Returns
    -------
    Spectrum
        Its ``wavevector`` is in rad/nm, its ``density`` in nm⁴.

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
        own_spectrum = read_own_spectrum(
            files, options, dataset=dataset, sphere_radius=sphere_radius
        )
    _warn_of_cautions(own_spectrum)
    spectrum = own_spectrum.spectrum
    if extrapolated and isinstance(spectrum, ScanSpectrum):
        return spectrum.extrapolated()
    return spectrum


def _warn_of_cautions(own_spectrum: OwnSpectrum) -> None:
    """Warn the caller of a public function of cautions on scans, and of filled pixels."""
    _, cautions = split_notes(own_spectrum.notes)
    for scan in own_spectrum.scans:
        if scan.undefined_count:
            cautions.append(f"{scan.name}: {scan.undefined_count} undefined pixels filled")
    for caution in cautions:
        warnings.warn(caution, stacklevel=3)


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
        A levelled scan. It is mirrored unless it is periodic.
    radius : float
        Radius of the sphere in nm.
    preload : float
        Load in N that presses the sphere on the scan at each contact.
    hardness : float
        Hardness of the softer body in Pa.
    rho : float or sequence of float
        Range of adhesion in nm, or several ranges.
    work : float
        Work of adhesion in J/m².
    window : float
        Width in nm of the square around each contact in which attraction is summed.
    contacts_per_row : int
        Number of contacts in each row of the square array.
    sphere : HeightMap or None
        Levelled roughness of the sphere where it touches. None stands for a smooth sphere.

    Returns
    -------
    xarray.Dataset
        Its variables are

        - ``pull_off_force`` (contact_model, rho, contact_y, contact_x) in N, for rigid and for
          plastic contact, at `work`. In the datasets of a study it is at 1 J/m².
        - ``apex_height`` (contact_model, contact_y, contact_x) in nm: the height of the sphere's
          apex above the mean plane at closest approach.
        - ``contact_pixel_count`` (contact_model): the number of pixels in each contact.
        - ``touched_patches``: the number of patches, groups of neighbouring pixels of the scan, in
          which the deepest pixels of the contacts lie. A periodic scan has none, because patches
          are those of a scan that is mirrored.
        - ``wider_window_change``: the largest relative change of plastic forces at the longest
          range if the window is wider by a period of the map on each side.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> forces = hc.pull_off_forces(
    ...     scan, radius=250e3, preload=10e-6, hardness=25e9, rho=5.6, work=0.0463
    ... )
    >>> mean = forces.pull_off_force.sel(contact_model="plastic").mean()  # N
    """
    quantities: dict[str, Any] = {"radius": radius, "preload": preload, "hardness": hardness}
    check_quantities(**quantities, work=work)
    contact = Contact(**quantities, window=window, contacts_per_row=contacts_per_row)
    ranges: Any = [rho] if np.isscalar(rho) else rho
    check_positive_numbers("rho", ranges)
    ranges = [float(rho_value) for rho_value in ranges]
    substrate, periodic_sphere = _periodic_maps(scan, sphere, contact, ranges)
    bodies = join_bodies(substrate, periodic_sphere, contact)
    forces = pull_off_dataset(bodies, contact, ranges)
    if scan.periodic:
        forces = forces.drop_vars("touched_patches")
    plastic_forces = forces.pull_off_force.sel(contact_model=[PLASTIC], rho=max(ranges))
    window_change = wider_window_change([bodies], replace(contact, rho=max(ranges)), plastic_forces)
    force = forces.pull_off_force * (work / WORK_OF_ADHESION)
    force.attrs = NEWTON | {"long_name": "pull-off force"}
    variables = {"pull_off_force": force, "wider_window_change": ((), window_change, DIMENSIONLESS)}
    return forces.assign(variables).assign_attrs(work_of_adhesion=work)


def _periodic_maps(
    scan: HeightMap, sphere: HeightMap | None, contact: Contact, ranges: Sequence[float]
) -> tuple[HeightMap, HeightMap | None]:
    """Return the periodic maps of both bodies; refuse a contact on them beyond the limits."""
    substrate = make_periodic(scan)
    periodic_sphere = None if sphere is None else make_periodic(sphere, "sphere")
    check_contact(substrate, contact, ranges)
    return substrate, periodic_sphere


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
    """Return relative forces on a scan without roughness beyond cutoffs, and edges of the band.

    An edge is the cutoff at which the force has changed by the tolerance. The edges are those of
    the scan alone, whereas a study adds extrapolated roughness.

    Parameters
    ----------
    scan : HeightMap
        As for `pull_off_forces`.
    cutoffs : mapping of str to sequence of float
        Cutoff wavelengths in nm, longer than two pixels and at most as long as the period of the
        map, which is twice the width of a mirrored scan. The side ``"short"`` removes the shorter
        wavelengths, the side ``"long"`` the longer ones. One side is enough.
    radius, preload, hardness : float
        As for `pull_off_forces`.
    rho : float
        Range of adhesion in nm.
    tolerance : float
        Relative change of the force that defines an edge.
    window, contacts_per_row, sphere : float, int, HeightMap or None
        As for `pull_off_forces`.

    Returns
    -------
    xarray.Dataset
        Its variables are

        - ``filtered_force_ratio`` (side, cutoff_wavelength): the mean plastic force relative to the
          force on the unfiltered scan. It is NaN at cutoffs of the other side.
        - ``edge`` (side) in nm. It is NaN unless it was found.
        - ``edge_status`` (side). ``"found"`` is an edge. ``"open_above"`` and ``"open_below"`` mean
          that the edge lies above or below ``edge_bound``. ``"ripples"`` means that ripples of the
          filter at steps, not the roughness, change the force.
        - ``edge_bound`` (side) in nm: the cutoff beyond which an open edge lies, NaN for others.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> ratios = hc.force_ratios(
    ...     scan, {"short": [40, 80, 160]}, radius=250e3, preload=10e-6, hardness=25e9, rho=5.6
    ... )
    >>> short_edge = float(ratios.edge.sel(side="short"))  # nm
    """
    quantities: dict[str, Any] = {"radius": radius, "preload": preload, "hardness": hardness}
    check_quantities(**quantities, rho=rho)
    check_tolerance(tolerance)
    contact = Contact(**quantities, rho=rho, window=window, contacts_per_row=contacts_per_row)
    substrate, periodic_sphere = _periodic_maps(scan, sphere, contact, [rho])
    check_cutoffs(cutoffs, substrate)
    forces = {}
    for side, side_cutoffs in cutoffs.items():
        wavelengths = sorted({float(wavelength) for wavelength in side_cutoffs})
        filters = Filters(side, substrate.pixels, wavelengths)
        side_forces = filtered_pull_off(substrate, filters, [contact], periodic_sphere)
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
    """Predict the pull-off force of a smooth sphere from a spectrum, or from a map.

    The force follows in closed form from the spectrum. On a map it is also summed over the pixels.

    Parameters
    ----------
    roughness : Spectrum or HeightMap
        Either a spectrum C_iso in nm⁴ over growing wavevectors in rad/nm, without gaps, or a
        levelled map, whose spectrum is measured at its reliable wavelengths.
    radius, preload, hardness, rho, work, tolerance : float
        As for `pull_off_forces` and `force_ratios`.

    Returns
    -------
    dict of str to Number
        The results of ``hardcontact predict`` by name. Each has a ``value``, a ``unit``, the ends
        ``low`` and ``high`` of its interval, and a ``status``. Forces are in N, lengths in nm.

        - Force: ``closed_form_force``; ``force_over_smooth``, the same force relative to
          ``smooth_force``, the force on a smooth surface. The status ``"outside"`` means that the
          error is not known, and ``"steep_sidewalls"`` that there is no value, because heights are
          not Gaussian.
        - Band: ``short_edge`` and ``long_edge``, where the force has changed by ``tolerance``. The
          status ``"outside"`` means that the error is not known, and ``"none"`` that no cutoff
          changes the force so much.
        - Extrapolated spectrum: ``extrapolated_change`` is the relative change of the force by
          waves beyond the spectrum. If its status is ``"matters"``, use ``extrapolated_force``,
          ``extrapolated_short_edge`` and ``extrapolated_long_edge``. ``extrapolated_to`` is the
          shortest wavelength of the extrapolated spectrum, ``extrapolated_rolloff`` its roll-off,
          and ``extrapolated_hurst`` the Hurst exponent of the added short waves.
        - Contact: ``apex_height`` is the height of the sphere's apex above the mean plane.
          ``weibull_modulus`` is above 1 if many points carry the force, below 1 if few summits do.
        - Spectrum: ``rms_height``, ``rms_gradient``, ``shortest_wavelength`` and
          ``longest_wavelength``.
        - Checks whether the error is known: ``longest_octave_change``, the relative change of the
          force without the longest octave; ``widest_gap``, the largest ratio of neighbouring
          wavelengths; ``skewness`` of the heights of scans, 0 for a table;
          ``validated_...``, a parameter, with the tested values as its interval.
        - ``reliable_force``, for an extrapolated spectrum of scans: the force of its reliable
          waves. If its status is ``"outside"``, call `predict` with the spectrum that is not
          extrapolated: its checks say why.

        For a map there are also

        - ``force_on_scan``, the mean force over contacts, summed over the pixels, and
          ``force_on_scan_over_smooth``. It has no value if its sum would take too long, or if
          `rho` is below ``shortest_range``. Then the other numbers of this list are missing.
        - ``log_force_std``, the standard deviation of ln F over contacts.
        - ``closed_form_on_scan``, the force in closed form for all waves of the map. Unless its
          status is ``"agrees"``, no number of the closed form has an interval.
        - ``wide_pixel_ratio``, the force on pixels four times wider relative to the map.
        - ``touched_patches``, as for `pull_off_forces`.
        - ``search_size``, the width of the square in which the sphere finds the summits that it
          touches.

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
    check_tolerance(tolerance)
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
    _warn_of_cautions(own_spectrum)
    return prediction_and_scan_force(own_spectrum, contact, tolerance, PAPER_CONFIDENCE)
