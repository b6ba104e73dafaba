"""A human model of one's own: who insists only after having waited for a while."""

from dataclasses import dataclass

import numpy as np

from cowalk.agents import Truth


@dataclass
class HesitantHuman:
    """Pushes sideways against every turn, but only once it has lasted for ``patience`` s."""

    patience: float = 1.0
    strength: float = 20.0

    def reset(self, rng, situation):
        self.period, self.pace, self.turning = situation.period, situation.pace, 0.0

    def act(self, observation):
        omega = observation["twist"][1]
        self.turning = self.turning + self.period if abs(omega) > 0.02 else 0.0
        self.insists = float(self.turning >= self.patience)
        return np.array([0.0, -self.strength * omega * self.insists])

    def truth(self):
        return Truth(np.array([self.pace, 0.0]), np.array([0.0, self.insists]))
