"""The usual order of operands that may be exchanged."""

from __future__ import annotations

from models.language.human.data import Command
from models.language.human.environment import environment
from models.language.human.lifting import lift
from models.language.human.operands import OperandOrder, swappable

EITHER = "finally ( and ( or ( go to the $1 room , go to the $2 room ) , finally ( go to the $3 room ) ) )"


def test_only_operands_of_commutative_operators_may_be_exchanged() -> None:
    assert swappable(EITHER) == ((0, 1),)
    assert swappable("and ( finally ( $1 ) , finally ( $2 ) )") == ((0, 1),)
    assert swappable("until ( not ( $1 ) , $2 )") == ()
    assert swappable("finally ( and ( $1 , finally ( $2 ) ) )") == ()
    assert swappable("finally go to the $1 room") == ()


def test_the_order_of_training_formulas_is_kept_whatever_is_said_first() -> None:
    formula = EITHER.replace("$1", "red").replace("$2", "yellow").replace("$3", "blue")
    command = lift(Command("go through the yellow or red room to the blue room", formula), environment("cleanup"))
    order = OperandOrder.of([command])
    assert order.usual(EITHER, ("yellow", "red", "green")) == ("red", "yellow", "green")
    assert order.usual(EITHER, ("yellow", "green", "red")) == ("yellow", "green", "red")
