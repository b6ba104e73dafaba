"""What ``cowalk new`` writes: a start for each kind of part, and for a scenario."""
