"""The first stages of planning for a test world, for tests of the later ones."""

from __future__ import annotations

from dataclasses import dataclass

from models.logic import Automaton, parse, translate
from models.planning.compiled import CompiledWorld, compile_world
from models.planning.graph import Predecessors, predecessors
from models.planning.product import Product, build_product
from models.planning.qualities import Qualities, analyse
from tests.planning.doubles import ArrayWorld


@dataclass(frozen=True)
class Stages:
    """What the planner knows before any number is computed."""

    world: ArrayWorld
    automaton: Automaton
    compiled: CompiledWorld
    product: Product
    graph: Predecessors
    qualities: Qualities

    @property
    def initial(self) -> int:
        """The initial node."""
        return self.product.node_of(self.automaton.initial, self.world.initial)


def stages(world: ArrayWorld, formula: str) -> Stages:
    """Compile, translate, multiply, analyse."""
    automaton = translate(parse(formula))
    compiled = compile_world(world)
    product = build_product(compiled, automaton, automaton.letters(world.labels(automaton.atoms)))
    graph = predecessors(product)
    return Stages(world, automaton, compiled, product, graph, analyse(product, graph))
