"""Height maps: reading scans, levelling and stitching, power spectra, filters, synthesis."""
