"""Memory of masters: the default's as before, the largest within a machine of 24 GB."""

from refusals import assert_says, refusal

from hardcontact.config.grids import master_megabytes, refuse_beyond_memory


def test_memory_grows_with_pixels_and_the_largest_master_fits_into_20_gb():
    assert 4000 < master_megabytes(16384, 3000) < 6000
    assert 15000 < master_megabytes(32768, 3000) < 20000


def test_a_master_beyond_the_memory_is_refused():
    refuse_beyond_memory("scales.small.pixels", 32768, 24000)
    refuse_beyond_memory("scales.small.pixels", 16384, 100)  # accepted everywhere, as before
    message = refusal(refuse_beyond_memory, "scales.small.pixels", 32768, 8000)
    assert_says(message, "scales.small.pixels", "16384", "8 GB", "32768")
