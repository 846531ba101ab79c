"""Commands for who writes a spec: begin one, check and format it, see what it says and what it becomes."""
