"""Robot files: read, judged, taken apart into solids and chains."""
