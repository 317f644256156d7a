"""Describe files that no reader can read, or that hold no heights, and say what to do."""

import io
import re
import zipfile
from collections.abc import Mapping

from SurfaceTopography.IO import MagicMatch, readers
from SurfaceTopography.Support.UnitConversion import is_length_unit

from hardcontact.scans.plain_text import ROW

#: SurfaceTopography's message on an unreadable file: a reader and its reason, in turn.
READER_MESSAGE = re.compile(r"tried (\w+): \n (.*?)\n\n(?=tried |\Z)", re.S)
#: The unit of values that a header of a text states.
VALUE_UNIT = re.compile(r"(?:value units|z-unit|unit data)\s*[:=]\s*(\S+)", re.I)
#: What to do with files that hold heights in a form that no reader takes.
EXPORT = "save the heights as text or netCDF, for example with Gwyddion"
PICTURE = f"a picture, whose grey values are not heights: {EXPORT}"
ARCHIVE = "an archive: unpack it, and give the scans in it"
MODEL = "a model of triangles or points: save its points as a text of x, y, height"
#: Kinds of files that no reader knows, in words with the remedy; values are their first bytes.
UNREADABLE_KINDS = {
    "a compressed file of MountainsMap: save it without compression": (b"DSCOMPRESSED",),
    ARCHIVE: (b"PK\3\4", b"BZh", b"\xfd7zXZ", b"7z\xbc\xaf", b"Rar!"),
    PICTURE: (b"BM", b"II*\0", b"MM\0*"),
}
#: The same for files without heights on a grid, for which no reader is tried.
KINDS_WITHOUT_HEIGHTS = {
    PICTURE: (b"P2\n", b"P5\n", b"\x89PNG", b"\xff\xd8\xff", b"GIF8"),
    MODEL: (b"#VRML", b"ply\n"),
    f"a document: {EXPORT}": (b"%PDF",),
}


def kind_in_words(content: bytes, kinds: Mapping[str, tuple[bytes, ...]]) -> str:
    """Return the kind of file that begins like this content, an empty text if none does."""
    return next((words for words, begin in kinds.items() if content.startswith(begin)), "")


def describe_unread(content: bytes, reader_messages: str) -> str:
    """Describe a file that no reader takes, with the reasons of the readers of its kind."""
    reasons = {
        name: " ".join(reason.split())[:200]
        for name, reason in READER_MESSAGE.findall(reader_messages)
    }
    lines = content[: 2**16].decode("utf-8", "replace").splitlines()
    start = content[:512]
    reader_names = [
        reader.__name__ for reader in readers if reader.can_read(start) == MagicMatch.YES
    ]
    kind = kind_in_words(content, UNREADABLE_KINDS)
    if zipfile.is_zipfile(io.BytesIO(content)):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if "[Content_Types].xml" in archive.namelist():
                return f"a document of an office program: {EXPORT}"
            if any(name.endswith("/main.xml") for name in archive.namelist()):
                reader_names = ["X3PReader"]
                kind = "an X3P with files in a folder: zip them without the folder"
    elif sum(ROW.fullmatch(line) is not None for line in lines) > len(lines) / 2:
        reader_names = ["AscReader"]
        unit = VALUE_UNIT.search("\n".join(lines))
        kind = "a text that is neither a matrix of equal rows nor columns of points"
        if unit and not is_length_unit(unit[1]):
            return (
                f"a text of values in {unit[1]}, which is no unit of length: multiply them by the "
                "sensitivity of the instrument, and state the unit of the heights"
            )
    descriptions = [f"{name}: {reasons[name]}" for name in reader_names if name in reasons]
    if kind:
        return "; ".join([kind, *descriptions])
    reasons_in_words = "; ".join(descriptions) or "one that none of its readers takes"
    return f"{reasons_in_words}; {EXPORT}"
