"""Read the fields of a scan from the bytes of its file, in any format of SurfaceTopography."""

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, NoReturn

import numpy as np
from SurfaceTopography import Topography
from SurfaceTopography.Exceptions import MetadataAlreadyFixedByFile
from SurfaceTopography.IO import AscReader, GWYReader, XYZReader

from hardcontact.base.formatting import format_length
from hardcontact.scans.heights import (
    LENGTH_BOUNDS,
    MAX_ASPECT_DEVIATION,
    TAKE_CARE,
    RefusedFile,
    line_scan_fields,
    map_fields,
    refuse_point_counts,
    unit_in_nm,
)
from hardcontact.scans.open_file import open_scan
from hardcontact.scans.plain_text import POINT_COLUMNS

#: Stands for a unit or a size that the user does not give.
NOT_GIVEN = "none"
#: Keys of metadata in a container, by the argument of a reader that takes their value.
KEY_BY_ARGUMENT = {"physical_sizes": "size", "unit": "unit", "height_scale_factor": "height_scale"}
#: Line scans with a finer spacing than this, in the unit of the text, are read with zero tolerance:
#: the reader's tolerance, 1e-6 of the unit, would be over 1 % of the spacing.
MAX_TOLERATED_SPACING = 1e-4
#: "Tip radius: 8 nm", "Initial tip radii - 17 nm" and the like in the description of a container.
TIP_RADIUS_IN_WORDS = re.compile(
    r"\btip\s+radi(?:us|i)\b[\s:=~≈\-–]*(\d+(?:\.\d+)?)\s*(nm|µm|μm|um)\b", re.I
)


def read_fields(
    content: bytes, dataset: str, undefined_pixels: str, unit: str, map_size: float | str, mask: str
) -> dict[str, Any]:
    """Return fields of a `HeightMap` from a file; the options are as in `api.read_scan`."""
    reader, container_metadata, notes = open_scan(content, dataset)
    unit = unit.replace("angstrom", "Å")
    # The dataset names a scan in a container, or else a channel of the file.
    channel, channel_notes = _find_height_channel(
        reader, container_metadata.get("data_source"), "" if container_metadata else dataset
    )
    topography, used_metadata = _read_topography(
        channel, container_metadata or _user_metadata(channel, unit, map_size)
    )
    _refuse_without_unit_or_size(topography)
    notes += channel_notes
    if used_metadata:
        source = "stated by the container" if container_metadata else "given by the user"
        notes.append(f"{', '.join(used_metadata)} ({source})".replace("_", " "))
    if mask == "keep" and isinstance(reader, GWYReader):
        topography, mask_notes = _keep_marked_pixels(topography)
        notes += mask_notes
    is_map = topography.dim == 2
    if is_map and isinstance(reader, AscReader):
        notes += _aspect_cautions(topography)
    try:
        find_fields = map_fields if is_map else line_scan_fields
        fields = find_fields(topography, unit_in_nm(topography.unit), undefined_pixels)
    except RefusedFile as error:
        # A unit that the user gave may suit only positions or only heights.
        remedy = "; --unit mm,nm (scan.unit: mm,nm) gives positions and heights a unit each"
        raise RefusedFile(f"{error}{remedy if unit == topography.unit else ''}") from None
    if not container_metadata:
        notes += _notes_on_unused_options(channel, unit, map_size)
    tip_radius, tip_notes = find_tip_radius(topography.info, container_metadata)
    return {
        "dataset": dataset if container_metadata or len(reader.channels) > 1 else "",
        "channel": channel.name,
        "file_unit": topography.unit,
        "tip_radius": tip_radius,
        **fields,
        "notes": [*notes, *fields["notes"], *tip_notes],
    }


def _refuse_without_unit_or_size(topography: Any) -> None:
    if topography.unit is None:
        raise RefusedFile(
            "expected a unit of length, found none in the file: state it for all files without a "
            "unit by --unit nm (scan.unit: nm), or mm,nm for positions and heights"
        )
    if topography.physical_sizes is None or not isinstance(topography.unit, str):
        raise RefusedFile(
            "expected a physical size and one unit, "
            f"found size {topography.physical_sizes}, unit {topography.unit}"
        )


def _aspect_cautions(topography: Any) -> list[str]:
    """Return a caution if the pixels of a text are not square, because lines may be missing."""
    pixel_width, pixel_height = np.divide(topography.physical_sizes, topography.nb_grid_pts)
    if abs(pixel_width / pixel_height - 1) <= MAX_ASPECT_DEVIATION:
        return []
    return [
        f"{TAKE_CARE}the pixels of this text are not square, perhaps because lines are missing: "
        f"heights are then stretched {pixel_height / pixel_width:.3g} times along y"
    ]


def _keep_marked_pixels(topography: Any) -> tuple[Any, list[str]]:
    """Return a map with any heights under its mask, and a caution on them."""
    unscaled_heights = topography.parent_topography.heights()
    is_marked = np.ma.getmaskarray(unscaled_heights)
    heights = np.ma.getdata(unscaled_heights) * topography.height_scale_factor
    # Where heights under a mask are undefined or equal, the mask marks gaps.
    if len(np.unique(heights[is_marked])) < 2:
        return topography, []
    caution = (
        f"{TAKE_CARE}its mask marks {is_marked.sum()} of {is_marked.size} pixels, whose heights "
        "count: --mask exclude (scan.mask: exclude) takes them for gaps"
    )
    sizes, unit = topography.physical_sizes, topography.unit
    return Topography(heights, sizes, unit=unit, info=topography.info), [caution]


def _user_metadata(channel: Any, unit: str, map_size: float | str) -> dict[str, Any]:
    """Return the user's metadata for a file that lacks them, by the keys of a container."""
    metadata: dict[str, Any] = {}
    lateral, _, vertical = unit.partition(",")
    if channel.unit is None and unit != NOT_GIVEN:
        metadata["unit"] = lateral
        if vertical:
            metadata["height_scale"] = unit_in_nm(vertical) / unit_in_nm(lateral)
    if map_size != NOT_GIVEN and channel.physical_sizes is None:
        # Without a unit, any size will do, because the file is refused for its unit.
        size_unit = metadata.get("unit", channel.unit) or "nm"
        pixel_size = float(map_size) / unit_in_nm(size_unit) / max(channel.nb_grid_pts)
        metadata["size"] = [pixel_size * count for count in channel.nb_grid_pts]
    return metadata


def _notes_on_unused_options(channel: Any, unit: str, map_size: float | str) -> Iterator[str]:
    """Yield a note for a unit and for a size of the user that the file contradicts."""
    if not isinstance(channel.unit, str):
        return
    if unit != NOT_GIVEN and unit_in_nm(unit.partition(",")[0]) != unit_in_nm(channel.unit):
        yield f"the given unit, {unit}, is not used: the file states {channel.unit}"
    if map_size != NOT_GIVEN and channel.physical_sizes is not None:
        size = max(channel.physical_sizes) * unit_in_nm(channel.unit)
        if not math.isclose(float(map_size), size, rel_tol=0.01):
            given_size, file_size = format_length(float(map_size)), format_length(size)
            yield f"the given size, {given_size}, is not used: the file states {file_size}"


def _read_topography(channel: Any, metadata: dict[str, Any]) -> tuple[Any, list[str]]:
    """Return the topography of a channel, and the metadata that its file lacked, in words."""
    _refuse_point_columns(channel)
    refuse_point_counts(channel.nb_grid_pts)
    has_positions = channel.dim == 1 and channel.is_uniform is False
    size = None if has_positions else tuple(metadata.get("size") or ()) or None
    _check_metadata(channel, metadata, size)
    if channel.physical_sizes is None and size is None and not has_positions:
        _refuse_without_size(channel, metadata)
    arguments = _accepted_arguments(channel, metadata | {"size": size})
    topography = channel.topography(**arguments)
    is_text_line = isinstance(channel.reader, XYZReader) and topography.dim == 1
    max_length = MAX_TOLERATED_SPACING * topography.nb_grid_pts[0]
    if is_text_line and abs(topography.physical_sizes[0]) <= max_length:
        topography = channel.reader._read(tol=0, **arguments)
    if size is not None:
        metadata = metadata | {"size": " x ".join(f"{length:.6g}" for length in size)}
    keys = [KEY_BY_ARGUMENT[argument] for argument in arguments]
    return topography, [f"{key} {metadata[key]}" for key in keys]


def _check_metadata(channel: Any, metadata: dict[str, Any], size: tuple[float, ...] | None) -> None:
    """Refuse a size or a height scale that is impossible."""
    if size is not None and not (len(size) == channel.dim and all(0 < x < math.inf for x in size)):
        raise RefusedFile(f"expected a size of {channel.dim} positive numbers, found {size}")
    scale = metadata.get("height_scale")
    if scale is not None and not 0 < scale < math.inf:
        raise RefusedFile(f"expected a positive height scale, found {scale}")


def _refuse_without_size(channel: Any, metadata: dict[str, Any]) -> NoReturn:
    """Refuse a channel whose size neither the file nor the metadata state."""
    lacks_unit = channel.unit is None and "unit" not in metadata
    remedy = ", and --unit nm (scan.unit: nm) the unit of the heights" if lacks_unit else ""
    raise RefusedFile(
        f"expected a file that states the physical size{' and unit' if lacks_unit else ''} of "
        "the scan, found none: "
        f"for example --size 5000nm (scan.map_size: 5000nm) gives the longer side{remedy}"
    )


def _refuse_point_columns(channel: Any) -> None:
    """Refuse a text of points that lie on no grid, which its reader takes for a matrix."""
    is_text = isinstance(channel.reader, AscReader)
    if is_text and channel.physical_sizes is None and channel.nb_grid_pts[0] <= POINT_COLUMNS:
        raise RefusedFile(
            "expected points x, y, height on a regular grid of which at least half are there, or a "
            f"matrix of more columns, found {channel.nb_grid_pts[0]} columns on no such grid: "
            "interpolate the points on a grid, for example with Gwyddion"
        )


def _accepted_arguments(channel: Any, metadata: dict[str, Any]) -> dict[str, Any]:
    """Return the metadata that the file itself lacks, by argument of the reader."""
    arguments: dict[str, Any] = {}
    for argument, key in KEY_BY_ARGUMENT.items():
        if metadata.get(key) is not None:
            # The call only tests whether the file accepts this argument.
            with suppress(MetadataAlreadyFixedByFile):
                channel.topography(**arguments | {argument: metadata[key]})
                arguments[argument] = metadata[key]
    return arguments


def _find_height_channel(reader: Any, data_source: Any, name: str) -> tuple[Any, list[str]]:
    """Return the channel of heights that user, container or reader choose, or the first; notes."""
    channels = reader.channels
    if data_source is not None and data_source not in range(len(channels)):
        raise RefusedFile(
            f"expected a data_source from 0 to {len(channels) - 1} in the container, "
            f"found {data_source}"
        )
    preferred = reader.default_channel if data_source is None else channels[data_source]
    # The reader takes phases and voltages of Nanoscope files for heights; their unit is a tuple.
    height_channels = [
        channel
        for channel in channels
        if channel.is_height_channel and not isinstance(channel.unit, tuple)
    ]
    if name:
        return _named_channel(channels, height_channels, name), []
    if not height_channels:
        names = ", ".join(f"{channel.name} ({_unit_in_words(channel)})" for channel in channels)
        raise RefusedFile(f"expected a channel of heights, found only {names}")
    if preferred.index not in [channel.index for channel in height_channels]:
        note = f"channel {height_channels[0].name} read: {preferred.name} holds no heights"
        return height_channels[0], [note]
    other_names = [channel.name for channel in height_channels if channel.name != preferred.name]
    is_chosen = data_source is not None or not other_names
    return preferred, [] if is_chosen else [f"other channels of heights: {', '.join(other_names)}"]


def _named_channel(channels: list[Any], height_channels: list[Any], name: str) -> Any:
    """Return the channel of heights with a name, or with its number among all channels from 1."""
    names = ", ".join(channel.name for channel in height_channels) or "none"
    matching = [channel for channel in channels if name in (channel.name, str(channel.index + 1))]
    if not matching:
        raise RefusedFile(
            f"expected one of the channels of heights ({names}), or its number among all "
            f"channels from 1; found {name!r}"
        )
    if matching[0] not in height_channels:
        raise RefusedFile(
            f"expected a channel of heights, found only {matching[0].name} "
            f"({_unit_in_words(matching[0])}); of heights: {names}"
        )
    return matching[0]


def _unit_in_words(channel: Any) -> str:
    """Return the unit of the values of a channel, the second if it has two."""
    unit = channel.unit[1] if isinstance(channel.unit, tuple) else channel.unit
    return str(unit or "of no stated unit")


def find_tip_radius(
    file_metadata: dict[str, Any], container_metadata: dict[str, Any]
) -> tuple[float | None, list[str]]:
    """Return the radius of the tip (nm) and a note on its source, or None without a note."""
    for source, metadata in (("file", file_metadata), ("container", container_metadata)):
        radius = _radius_in_numbers(metadata)
        if radius is not None:
            return radius, [f"tip radius of {radius:.4g} nm stated by the {source}"]
    matches = TIP_RADIUS_IN_WORDS.findall(str(container_metadata.get("description") or ""))
    if not matches:
        return None, []
    # The largest radius counts, because a worn tip limits the scan.
    radius = max(float(value) * unit_in_nm(unit) for value, unit in matches)
    return radius, [f"largest tip radius in the container's description, {radius:.4g} nm"]


def _radius_in_numbers(metadata: dict[str, Any]) -> float | None:
    """Return the radius (nm) of the tip in metadata; None if it is missing or not plausible."""
    try:
        tip_radius = metadata["instrument"]["parameters"]["tip_radius"]
        radius = float(tip_radius["value"]) * unit_in_nm(tip_radius["unit"])
    except (LookupError, TypeError, ValueError, RefusedFile):
        return None
    return radius if LENGTH_BOUNDS[0] <= radius <= LENGTH_BOUNDS[1] else None
