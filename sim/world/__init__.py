"""What the pair walks through, how far away it is, and who sees it."""
