"""How well an estimate follows the truth."""
