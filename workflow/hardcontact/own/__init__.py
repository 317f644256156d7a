"""What only studies of own surfaces need: forces on few scans, predictions, fits to own forces."""
