"""The protocol of a plant, plain discs for bodies, and the plants by name."""
