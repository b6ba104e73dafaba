"""Who watches a run: films and recordings."""
