"""What comes out of a command, as people and programs read it: tables, progress, figures, plain data."""
