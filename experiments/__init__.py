"""What the method achieves: the claims of the README, the paper's arms, the shipped worlds."""
