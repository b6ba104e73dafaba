"""YAML text from anybody, as plain data: bounded, without code, every fault with its line."""
