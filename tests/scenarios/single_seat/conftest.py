"""What tests of single-seat environments share."""

import gymnasium
import pytest

from cowalk.scenarios.single_seat.registration import ids


@pytest.fixture
def seat_of():
    """Make single-seat environments, unwrapped, that are closed in the end."""
    made = []
    names = {arguments.get("scenario"): name for name, arguments in ids().items()}

    def one(scenario="paper-open-loop", **arguments):
        name = names.get(scenario) if isinstance(scenario, str) else None
        if name is None:
            name, arguments["scenario"] = names[None], scenario
        made.append(gymnasium.make(name, **arguments).unwrapped)
        return made[-1]

    yield one
    for env in made:
        env.close()
