"""What a run amounts to, in numbers: cost, negotiation, smoothness, and what was believed."""
