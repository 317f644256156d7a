"""Captions and images of the report for a page: templates as plain text, small pictures."""

from collections.abc import Mapping
from io import BytesIO
from types import SimpleNamespace
from typing import Any, NamedTuple

#: Nothing but the text itself, and an error for what is no markup.
SETTINGS = {
    "_disable_config": True,
    "file_insertion_enabled": False,
    "raw_enabled": False,
    "halt_level": 2,
}


class Caption(NamedTuple):
    """A caption in plain text.

    Attributes
    ----------
    title : str
        What stands in bold before it, without the full stop.
    text : str
        The rest, in one line.
    """

    title: str
    text: str


def caption(template: str, configuration: Mapping[str, Any]) -> Caption:
    """Return a caption as the report shows it, without its markup.

    Parameters
    ----------
    template : str
        A caption of workflow/report: reStructuredText that begins with its title in bold, and in
        which a template of Jinja names keys of the configuration.
    configuration : mapping
        Of the study, as it was given.

    Returns
    -------
    Caption
        Title and text.

    Raises
    ------
    ValueError
        If the caption does not begin with a title.
    """
    from docutils.core import publish_doctree
    from docutils.nodes import strong
    from jinja2 import Environment, StrictUndefined

    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    study = SimpleNamespace(config=configuration)
    filled = environment.from_string(template).render(snakemake=study)
    document = publish_doctree(filled, settings_overrides=SETTINGS)
    whole = " ".join(document.astext().split())
    bold = [" ".join(node.astext().split()) for node in document.findall(strong)]
    if not bold or not whole.startswith(bold[0]):
        raise ValueError(f"expected a caption that begins with its title in bold, found {whole!r}")
    return Caption(bold[0].removesuffix("."), whole.removeprefix(bold[0]).strip())


COLOURS = 256  # of the palette, which PNG keeps in one byte a pixel


def web_png(png_bytes: bytes, width: int) -> bytes:
    """Return an image that is at most so wide, in the colours that suit it best.

    Parameters
    ----------
    png_bytes : bytes
        An image, as PNG.
    width : int
        In pixels; an image that is narrower keeps its size.

    Returns
    -------
    bytes
        PNG, the same for the same image.
    """
    from PIL import Image

    with Image.open(BytesIO(png_bytes)) as image:
        opaque = image.convert("RGB")
    if opaque.width > width:
        height = round(opaque.height * width / opaque.width)
        opaque = opaque.resize((width, height), Image.Resampling.LANCZOS)
    reduced = opaque.quantize(COLOURS, dither=Image.Dither.NONE)
    written = BytesIO()
    reduced.save(written, "PNG", optimize=True)
    return written.getvalue()
