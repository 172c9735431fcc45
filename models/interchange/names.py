"""Names as PRISM and DRN take them: letters, digits and `_`, none twice, no reserved word.

`pick(red cube)` becomes `pick_red_cube`, `étagère` becomes `etagere`, `7up` becomes `_7up`; what would be there twice
gets `_2`, `_3`, ... Files that use such names say in comments what they stand for.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

from models.logic import Atom, atom_text

_WORDS = """
A bool ceil clock const ctmc C double dtmc E endinit endinvariant endmodule endobservables endplayer endrewards
endsystem F false filter floor formula func G global I init int interval invariant label log ma max mdp min mod module
multi nondeterministic observable observables of P player Pmax Pmin pomdp popta pow probabilistic prob pta R rate
rewards Rmax Rmin round S smg stochastic system true U W X
"""  # of PRISM 4.8, and what Storm adds
_RESERVED = frozenset(_WORDS.split())
_RESERVED_LABELS = _RESERVED | {"deadlock", "init", "out_of_bounds"}
_LONGEST = 80
_OTHER = re.compile(r"[^A-Za-z0-9_]+")


class Identifiers:
    """Gives out identifiers of one namespace, each once."""

    def __init__(self, reserved: Iterable[str] = _RESERVED) -> None:
        self._taken = set(reserved)

    def new(self, name: str) -> str:
        """An identifier like `name` that was not given out before."""
        base = mangled(name)
        chosen, count = base, 1
        while chosen in self._taken:
            count += 1
            chosen = f"{base}_{count}"
        self._taken.add(chosen)
        return chosen


def mangled(name: str) -> str:
    """The name with everything but letters, digits and `_` replaced."""
    plain = unicodedata.normalize("NFKD", name)
    plain = "".join(character for character in plain if not unicodedata.combining(character))
    plain = _OTHER.sub("_", plain)[:_LONGEST].strip("_") or "_"
    return f"_{plain}" if plain[0].isdigit() else plain


def label_names(atoms: Sequence[Atom], *, reserved: Iterable[str] = ()) -> dict[Atom, str]:
    """The label that stands for each atom in PRISM and DRN: `in(cylinder, box)` -> `in_cylinder_box`."""
    names = Identifiers(_RESERVED_LABELS | set(reserved))
    return {atom: names.new(atom_text(atom)) for atom in dict.fromkeys(atoms)}


def action_names(actions: Sequence[str], *, reserved: Iterable[str] = ()) -> list[str]:
    """The identifier of each action of a world, and last one for standing still, which no action has."""
    names = Identifiers(_RESERVED | set(reserved))
    return [names.new(action) for action in (*actions, "stay")]


def number_text(value: float) -> str:
    """A number as PRISM and DRN read it back: `1`, `0.25`, `1e-05`."""
    return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(float(value))
