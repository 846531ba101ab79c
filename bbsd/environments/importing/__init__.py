"""What a user allowed to be imported, and how that is imported."""
