"""Let PPO learn the automation's seat of the puddle for 2,000 steps: enough to see that it runs."""

import time

import gymnasium
from stable_baselines3 import PPO
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.monitor import Monitor

STEPS = 2000
EPISODES = 10


def make():
    """Return the environment: a partner is drawn for every episode."""
    name = "cowalk.scenarios:cowalk/Puddle-v0"
    return Monitor(gymnasium.make(name, partner=["escalating", "steady"]))


def evaluated(model):
    """Return mean and deviation of the return of one episode, always of the same ones."""
    env = make()
    env.reset(seed=1)
    mean, deviation = evaluate_policy(model, env, EPISODES)
    env.close()
    return f"{mean:.2f} +- {deviation:.2f}"


def main():
    """Print the return before and after learning, and how fast it went."""
    env = make()
    model = PPO("MlpPolicy", env, n_steps=500, batch_size=100, seed=0, device="cpu")
    before = evaluated(model)
    started = time.perf_counter()
    model.learn(STEPS)
    speed = STEPS / (time.perf_counter() - started)
    print(f"return of an episode: {before} untrained, {evaluated(model)} after {STEPS} steps")
    real = speed * env.unwrapped.scenario.rates.period
    print(f"learning: {speed:.0f} steps/s, {real:.0f} x real time")
    env.close()


if __name__ == "__main__":
    main()
