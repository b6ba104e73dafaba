"""The paper's equations: wish and stubbornness from force."""
