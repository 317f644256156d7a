"""Height maps: scans, levelling and stitching, power spectra, filters, synthesis, features."""
