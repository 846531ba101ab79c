"""What reports say alike: numbers, bars, why runs ended, and what a reader should know beside the figures."""
