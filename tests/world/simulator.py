"""Toys and navigation written again in plain Python, state by state, from their description alone.

A state is a tuple: the robot's cell, then the box and each toy: a cell (column, row), "held" or, for toys, "boxed".
"""

from __future__ import annotations

from itertools import product

SIDES = {"north": ("west", "east"), "south": ("west", "east"), "east": ("north", "south"), "west": ("north", "south")}
STEP = {"north": (0, -1), "south": (0, 1), "east": (1, 0), "west": (-1, 0)}


class Toys:
    """A grid of cells with walls, one box, k toys."""

    def __init__(self, columns, rows, toys, slip, walls=()):
        self.cells = [(x, y) for y in range(rows) for x in range(columns)]
        self.toys = toys
        self.slip = slip
        self.walls = {frozenset(wall) for wall in walls}

    def states(self):
        """Every state, the robot first, then box and toys, the last varying fastest."""
        box = [*self.cells, "held"]
        toy = [*self.cells, "held", "boxed"]
        return list(product(self.cells, box, *[toy] * self.toys))

    def legal(self, state):
        return sum(place == "held" for place in state[1:]) <= 1

    def go(self, cell, direction):
        dx, dy = STEP[direction]
        ahead = (cell[0] + dx, cell[1] + dy)
        return cell if ahead not in self.cells or frozenset({cell, ahead}) in self.walls else ahead

    def moves(self, state):
        """(action, {successor: probability}) for each action possible in a legal state."""
        robot, box = state[:2]
        hand_free = "held" not in state[1:]
        for direction in STEP:
            chances = {}
            left, right = SIDES[direction]
            for way, chance in ((direction, 1 - self.slip), (left, self.slip / 2), (right, self.slip / 2)):
                if chance:
                    target = (self.go(robot, way), *state[1:])
                    chances[target] = chances.get(target, 0) + chance
            yield direction, chances
        for thing in range(1, len(state)):
            if state[thing] == robot and hand_free:
                yield f"pick {thing}", self.grasp(state, thing)
            if state[thing] == "held":
                yield f"drop {thing}", {self.with_(state, thing, robot): 1.0}
        for thing in range(2, len(state)):
            if state[thing] == "held" and box == robot:
                yield f"put {thing}", {self.with_(state, thing, "boxed"): 1.0}
            if state[thing] == "boxed" and box == robot and hand_free:
                yield f"take {thing}", self.grasp(state, thing)

    def grasp(self, state, thing):
        chances = {self.with_(state, thing, "held"): 1 - self.slip, state: self.slip}
        return {target: chance for target, chance in chances.items() if chance}

    @staticmethod
    def with_(state, index, value):
        return (*state[:index], value, *state[index + 1 :])

    # Propositions, by their meaning.

    def place(self, state, thing):
        """Where a thing rests, or None when it is held, itself or with the box."""
        if state[thing] == "boxed":
            return self.place(state, 1)
        return None if state[thing] == "held" else state[thing]

    def carried(self, state, thing):
        return state[thing] == "held" or (state[thing] == "boxed" and state[1] == "held")
