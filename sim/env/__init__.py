"""The PettingZoo environment: what it is made with, actions, perception, reward, snapshots."""
