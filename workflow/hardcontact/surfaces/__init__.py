"""Height maps and their metrics, power spectra, filters; random surfaces and substitutes."""
