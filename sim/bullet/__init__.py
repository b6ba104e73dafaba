"""The PyBullet plant: two bodies joined by a constraint, whose reaction is measured."""
