"""Images made for print, small enough for a page."""

from io import BytesIO

__all__ = ["web_png"]

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
