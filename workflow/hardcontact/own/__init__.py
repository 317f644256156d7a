"""What only the user's surfaces need, in a study or in a prediction without a study."""
