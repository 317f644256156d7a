"""Choose the channel of heights in a file that may also have other channels."""

from typing import Any

from hardcontact.scans.heights import RefusedFile


def find_height_channel(reader: Any, entry: dict[str, Any], name: str) -> tuple[Any, list[str]]:
    """Return the channel of heights that the user, else the container or the reader, chooses.

    The user's channel, by `name`, is refused if it holds no heights. Without heights, the choice of
    the container (its `entry`) or of the reader is replaced by the first channel of heights, with a
    note.
    """
    channels = reader.channels
    container_index = entry.get("data_source")
    if container_index is not None and container_index not in range(len(channels)):
        raise RefusedFile(
            f"expected a data_source from 0 to {len(channels) - 1} in the container, "
            f"found {container_index}"
        )
    preferred = reader.default_channel if container_index is None else channels[container_index]
    # The reader takes phases and voltages of Nanoscope files for heights; they have two units.
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
    is_chosen = container_index is not None or not other_names
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
    """Return the unit of the values of a channel, which is the second if there are two units."""
    unit = channel.unit[1] if isinstance(channel.unit, tuple) else channel.unit
    return str(unit or "of no stated unit")
