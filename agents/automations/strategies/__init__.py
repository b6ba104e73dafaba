"""How much an automation concedes, one file a strategy."""
