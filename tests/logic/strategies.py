"""Hypothesis strategies for formulas, and words to try them on."""

from __future__ import annotations

from hypothesis import strategies as st

from models.logic import FALSE, TRUE, Atom, Binary, Formula, Name, Op, Parameter, Unary, nary

NASTY = [
    "X", "F", "G", "U", "R", "W", "M", "true", "false", "TRUE", "False", "0", "1", "42", "and", "or", "not", "V",
    "FG", "Fa", "GF", "_", "_a", "a_", "a b", " a", "a ", "  ", "a  b", "H&M (2nd floor)", "a'b", "#3", "x-y", "->",
    "!", "&", "[]", "<>", "(", ")", "()", "{", "}", "{}", "a{}b", "\\", "\\\\", "\\_", "\\text{a}",
    "\\textbackslash{}", "\\mathrm{F}", "\\neg", "\"", "\\\"", "\"\"", "$", "$1", "$$", "%", "#", "^", "~", "_{1}",
    "p_{12}", "é", "e\u0301", "房間", "кот", "◇", "¬a", "²", "𝓕", "😀", "\u00a0", "a\u2003b", "\u200b", "phi",
    "mathrm", "in", ",", "a,b", ".", "<->", "\\,", "\\ ", "\\left(", "``", "“q”",
]  # fmt: skip

names = st.one_of(
    st.sampled_from(["a", "b", "in", "at", "small_bucket"]),
    st.sampled_from(NASTY),
    st.text(st.characters(blacklist_categories=["Cc", "Cs", "Zl", "Zp"]), min_size=1, max_size=8),
)
terms = st.one_of(names.map(Name), st.integers(1, 30).map(Parameter))
nasty_atoms = st.builds(Atom, names, st.lists(terms, max_size=3).map(tuple))
plain_atoms = st.sampled_from([Atom("a"), Atom("b"), Atom("c")])

UNARY = [Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY]
BINARY = [Op.IMPLIES, Op.IFF, Op.UNTIL, Op.RELEASE, Op.WEAK_UNTIL, Op.STRONG_RELEASE]


def formulas(atoms: st.SearchStrategy[Atom], *, max_leaves: int = 12) -> st.SearchStrategy[Formula]:
    """Formulas over `atoms` with every operator and both constants."""
    leaves = st.one_of(atoms, atoms, st.sampled_from([TRUE, FALSE]))
    return st.recursive(leaves, _extend, max_leaves=max_leaves)


def cosafe_formulas(atoms: st.SearchStrategy[Atom], *, max_leaves: int = 8) -> st.SearchStrategy[Formula]:
    """Formulas that are co-safe by their form: negation only of atoms, and X, F, U and M."""
    leaves = st.one_of(atoms, atoms.map(lambda a: Unary(Op.NOT, a)), st.sampled_from([TRUE, FALSE]))
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            st.builds(Unary, st.sampled_from([Op.NEXT, Op.FINALLY]), inner),
            st.builds(Binary, st.sampled_from([Op.UNTIL, Op.STRONG_RELEASE]), inner, inner),
            _nary(inner),
        ),
        max_leaves=max_leaves,
    )


def _extend(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    return st.one_of(
        st.builds(Unary, st.sampled_from(UNARY), inner),
        st.builds(Binary, st.sampled_from(BINARY), inner, inner),
        _nary(inner),
    )


def _nary(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    return st.builds(
        lambda op, parts: nary(op, *parts), st.sampled_from([Op.AND, Op.OR]), st.lists(inner, min_size=2, max_size=4)
    )
