"""What only the study of the paper needs: fits to published forces, sets, claims, verdicts."""
