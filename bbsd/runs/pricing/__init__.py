"""What a design will cost, by a sample of real episodes; and the budget that some seconds are."""
