"""Human models, one file each; `cowalk.agents.registry` finds them by name."""
