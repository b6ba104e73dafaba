"""Who watches a run: films, and recordings for the Rerun viewer."""
