from __future__ import annotations

import math

from models.language.spans.calibration import TEMPERATURES, best_temperature


def test_the_temperature_is_the_one_of_highest_likelihood() -> None:
    # Answers given with log-odds 4 that are right in 3 of 4 cases are as sure as log-odds log 3: a temperature of 3.64.
    def likelihood(temperature: float) -> float:
        sure = 1 / (1 + math.exp(-4 / temperature))
        return 3 * math.log(sure) + math.log(1 - sure)

    best = best_temperature(likelihood)
    assert abs(math.log(best / (4 / math.log(3)))) <= math.log(1.1) / 2
    assert best in TEMPERATURES
