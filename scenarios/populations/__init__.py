"""The populations that ship, one ``*.population.yaml`` each."""
