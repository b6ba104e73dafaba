"""What is negotiated: the cost of an arc, a wish, the Pareto front, utility."""
