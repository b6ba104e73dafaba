"""Two bodies that hold on to each other: what they are, whatever moves them. Pure."""
