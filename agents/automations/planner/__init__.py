"""What is negotiated: cost, wish, Pareto front, utility."""
