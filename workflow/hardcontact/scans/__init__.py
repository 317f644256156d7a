"""Measured scans, and the spectrum of the surface that they show.

`reading` reads a file of any microscope in a child process: `open_file` and `plain_text` open it,
`formats` and `heights` read its fields. `defects` finds what is wrong with a scan, `reliable_band`
the wavelengths at which its `measured_spectrum` shows the surface. `joined_spectrum` joins the
spectra of all scans by their `mean_spectrum`, and extrapolates them by a `tail` and a `rolloff`.
`both_bodies` adds the roughness of the sphere.
"""
