"""Measured scans, and the spectrum of the surface that they show.

`reading` reads a file of any microscope in a child process: `open_file` and `plain_text` open it,
`formats` and `heights` read its fields. `defects` finds defects of a scan, `scan_pairs` pairs that
show one area or contradict each other, and `reliable_wavelengths` those of a `measured_spectrum`
that show the surface. `joined_spectrum` joins the spectra of all scans, and `extrapolation` extends
their mean. `both_bodies` adds the roughness of the sphere, and `spectrum_datasets` stores spectra
with their measurements.
"""
