"""What only studies of the user's surfaces need: forces on few scans, predictions, fits."""
