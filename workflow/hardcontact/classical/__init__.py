"""Classical models of smooth and rough spheres, fitted to the same forces."""
