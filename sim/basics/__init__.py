"""What everybody may import: errors, validators, motion, paths, what is observed."""
