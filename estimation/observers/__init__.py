"""Observers: from measured force to stubbornness and wish, one file each."""
