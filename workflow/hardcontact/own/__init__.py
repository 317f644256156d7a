"""Forces on own surfaces: spectra of scans, predictions, and what of them scans show."""
