"""What an environment shows and takes, and how a spec names it."""
