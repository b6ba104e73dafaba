"""How an automation negotiates and concedes: the loop that strategies share, one file each."""
