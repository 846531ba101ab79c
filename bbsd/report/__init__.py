"""Results as people and programs read them: tables, progress, figures, JSON, the language's reference."""
