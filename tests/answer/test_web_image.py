"""Pictures of print made smaller for a page: size, colours, bytes."""

from io import BytesIO

import numpy as np
from PIL import Image

from hardcontact.answer.captions import web_png


def png(pixels):
    written = BytesIO()
    Image.fromarray(pixels).save(written, "PNG")
    return written.getvalue()


def opened(data):
    return np.asarray(Image.open(BytesIO(data)).convert("RGB"))


def gradient(height=300, width=600):
    y, x = np.mgrid[:height, :width]
    return np.stack([255 * x / width, 255 * y / height, 0 * x + 60], -1).astype(np.uint8)


def test_a_wide_picture_becomes_narrower_in_proportion():
    assert opened(web_png(png(gradient()), 200)).shape == (100, 200, 3)


def test_a_narrow_picture_keeps_its_size():
    assert opened(web_png(png(gradient()), 1000)).shape == (300, 600, 3)


def test_few_colours_stay_what_they_are():
    pixels = np.zeros((40, 60, 4), np.uint8)
    pixels[..., 3] = 255
    pixels[:20, :, 0], pixels[:, 30:, 2] = 213, 178
    np.testing.assert_array_equal(opened(web_png(png(pixels), 60)), pixels[..., :3])


def test_many_colours_stay_near():
    off = np.abs(opened(web_png(png(gradient()), 600)).astype(int) - gradient())
    assert np.sqrt((off**2).mean()) < 12


def test_a_small_symbol_among_many_pale_colours_keeps_its_own():
    noise = np.random.default_rng(1).normal(0, 15, (300, 600, 3))
    pixels = np.clip(np.linspace(120, 255, 600)[:, None] + noise, 0, 255).astype(np.uint8)
    blue = pixels[100:104, 300:304] = np.array([0, 114, 178])
    shown = opened(web_png(png(pixels), 600))[100:104, 300:304].astype(int)
    assert np.abs(shown - blue).max() < 12


def test_print_becomes_small():
    rng = np.random.default_rng(1)
    noisy = np.clip(gradient(450, 1050) + rng.normal(0, 10, (450, 1050, 1)), 0, 255)
    data = png(noisy.astype(np.uint8))
    assert len(web_png(data, 700)) < 0.5 * len(data)


def test_the_bytes_are_the_same_each_time():
    assert web_png(png(gradient()), 200) == web_png(png(gradient()), 200)
