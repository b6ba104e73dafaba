"""Robot files: read, judged, taken apart into shapes and chains."""
