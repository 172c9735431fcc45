"""How names are written: bare where they can be, quoted where they must be, and LaTeX's own way.

Bare names start with a letter or `_` and go on with letters, digits and `_`, of any script. Every other name, and one
equal to a reserved word (`X F G U R W M`, `true` and `false` in any case), is quoted: `"H&M (2nd floor)"`, with a
backslash before `"` and before a backslash. In LaTeX a quoted name is `\\text{...}` and a bare one `\\mathrm{...}`.
"""

from __future__ import annotations

import re

_BARE = re.compile(r"(?!(?:[XFGURWM]|(?i:true|false))\Z)[^\W\d]\w*", re.ASCII)
_BARE_ANY_SCRIPT = re.compile(_BARE.pattern)

_LATEX_ESCAPES = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{character: "\\" + character for character in "{}_$%&#"},
}
_LATEX_WORDS = {escape: character for character, escape in _LATEX_ESCAPES.items()}
_LATEX_ESCAPE = re.compile(r"\\text(?:backslash|asciitilde|asciicircum)\{\}|\\.|\s", re.DOTALL)
_SUBSCRIPT = re.compile(r"_\{(\w+)\}")


def to_quotable(name: str) -> str:
    """The name as the plain dialects write it: bare, or in double quotes."""
    if _BARE_ANY_SCRIPT.fullmatch(name):
        return name
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def to_latex(name: str) -> str:
    """The name as LaTeX writes it."""
    if _BARE.fullmatch(name):
        return r"\mathrm{" + name.replace("_", r"\_") + "}"
    written: list[str] = []
    for index, character in enumerate(name):
        edge = index in (0, len(name) - 1) or name[index - 1] == " "
        if character == " " and edge:  # LaTeX drops spaces at the edges and all but one of several
            written.append("\\ ")
        else:
            written.append(_LATEX_ESCAPES.get(character, character))
    return r"\text{" + "".join(written) + "}"


def from_token(kind: str, text: str) -> str:
    """The name that a token of the grammar spells; `kind` is its terminal."""
    if kind == "QUOTED":
        return re.sub(r"\\(.)", r"\1", text[1:-1])
    if kind == "TEXT":
        return _from_latex(text[text.index("{") + 1 : -1])
    if kind in ("FONT_NAME", "FONT_WORD"):
        return _from_latex(text[text.index("{") + 1 : -1]).strip()
    return _SUBSCRIPT.sub(r"_\1", text.removeprefix("\\") if kind == "GREEK" else text.replace("\\_", "_"))


def _from_latex(text: str) -> str:
    def unescape(match: re.Match[str]) -> str:
        found = match.group()
        if found in ("\n", "\r", "\t"):  # a line may be broken inside the braces
            return " "
        return _LATEX_WORDS.get(found, found.removeprefix("\\"))

    return _LATEX_ESCAPE.sub(unescape, text)
