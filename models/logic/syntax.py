"""Syntax errors of formulas as sentences with a place: what was expected, what was found, and perhaps a hint."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NoReturn

from lark import Token
from lark.exceptions import UnexpectedInput, UnexpectedToken

from models.logic.errors import FormulaSyntaxError
from models.source import locate, quoted

_OPERAND = "a proposition or an operator before one"
_FUNCTIONS = frozenset({"NAME", "FONT_NAME", "GREEK", "QUOTED", "TEXT"})
_OPERAND_ENDS = _FUNCTIONS | {"TRUE", "FALSE", "RPAR", "RBRACE"}
_CLOSING = {"(": ")", "{": "}"}
_LETTERS = frozenset("XFGURWM")
_WORDS = {"and": "&", "or": "|", "not": "!", "implies": "->", "iff": "<->"}


@dataclass(frozen=True, slots=True)
class Bracket:
    """An opening `(` or `{` that is not closed yet; `arguments` tells those of an atom from a grouping."""

    text: str
    position: int
    arguments: bool


@dataclass(slots=True)
class Reading:
    """How far a reading of the text got: the last two tokens, and the brackets open after them."""

    text: str
    prefix: bool
    last: Token | None = None
    before_last: Token | None = None
    open_brackets: list[Bracket] = field(default_factory=list)

    def take(self, token: Token) -> None:
        """Note a token that the parser is about to be given."""
        if token.type in ("LPAR", "LBRACE"):
            arguments = token.type == "LPAR" and self.last is not None and self.last.type in _FUNCTIONS
            self.open_brackets.append(Bracket(str(token), token.start_pos or 0, arguments))
        elif self.open_brackets and _CLOSING[self.open_brackets[-1].text] == token:
            # One that does not match stays on the stack for the error that the parser is going to raise.
            self.open_brackets.pop()
        self.before_last, self.last = self.last, token

    def refuse_last(self) -> None:
        """Note that the parser did not take the last token after all."""
        self.last = self.before_last


def refuse(text: str, position: int, detail: str) -> NoReturn:
    """Raise FormulaSyntaxError at a 0-based position of the text."""
    at = locate(text, position)
    raise FormulaSyntaxError(
        f"line {at.line}, column {at.column}: {detail}", line=at.line, column=at.column, caret=at.caret
    ) from None


def complain(reading: Reading, error: UnexpectedInput) -> NoReturn:
    """Raise FormulaSyntaxError for what Lark could not read."""
    text = reading.text
    if not text.strip():
        refuse(text, 0, "the formula is empty")
    position: int = getattr(error, "pos_in_stream", None) or 0
    if isinstance(error, UnexpectedToken) and error.token.type == "$END":
        position = len(text.rstrip())
    elif reading.last is not None and reading.last.start_pos == position:
        reading.refuse_last()
    hint = _hint(reading, position)
    sentence = f"expected {_expected(reading, error)}, found {_found(text, position)}"
    refuse(text, position, f"{sentence}; {hint}" if hint else sentence)


def _expected(reading: Reading, error: UnexpectedInput) -> str:
    last = reading.last.type if reading.last is not None else ""
    if reading.open_brackets and reading.open_brackets[-1].arguments:
        if last in ("LPAR", "COMMA"):
            return "a name, a quoted name or a parameter such as $1"
        return "`,` or `)` after an argument"
    if last not in _OPERAND_ENDS:
        return _OPERAND
    if reading.prefix:
        return _OPERAND if isinstance(error, UnexpectedToken) and "NAME" in error.expected else "the end"
    if reading.open_brackets:
        return f"an operator or `{_CLOSING[reading.open_brackets[-1].text]}`"
    return "an operator or the end"


def _found(text: str, position: int) -> str:
    if position >= len(text.rstrip()):
        return "the end"
    word = re.compile(r"\w+|\\[a-zA-Z]+|\S|\s").match(text, position)
    return quoted(word.group() if word else text[position])


def _hint(reading: Reading, position: int) -> str:
    rest = reading.text[position : position + 40]
    if not rest.strip():
        return _unclosed(reading)
    if rest[0] in ")}":
        return _stray(reading, rest[0])
    return _word_hint(reading, rest) or _sign_hint(reading, rest[0]) or _name_hint(reading, position, rest[0])


def _unclosed(reading: Reading) -> str:
    if not reading.open_brackets:
        return ""
    opened = reading.open_brackets[-1]
    at = locate(reading.text, opened.position)
    return f"the `{opened.text}` at line {at.line}, column {at.column} is never closed"


def _stray(reading: Reading, closing: str) -> str:
    if not reading.open_brackets:
        return f"no `{'(' if closing == ')' else '{'}` is open here"
    opened = reading.open_brackets[-1]
    if _CLOSING[opened.text] == closing:
        return ""
    at = locate(reading.text, opened.position)
    return f"the bracket open here is the `{opened.text}` at line {at.line}, column {at.column}"


def _word_hint(reading: Reading, rest: str) -> str:
    """For a word, or the one before it, that is or is not an operator against expectation."""
    here = match.group() if (match := re.match(r"\w+", rest)) else ""
    for word in (here, str(reading.last or "")):
        if word.lower() in _WORDS and word not in _LETTERS:
            return f"write {_WORDS[word.lower()]} for {quoted(word)}"
    if here in _LETTERS:
        return f'{here} is an operator; a name that is spelt so is quoted: "{here}"'
    return ""


def _sign_hint(reading: Reading, sign: str) -> str:
    """For a sign that means something elsewhere."""
    hints = {
        "=": "equivalence is written <->, and propositions hold no comparisons",
        "[": "group with parentheses; `[]` means always",
        '"': "" if reading.last is not None and reading.last.type in _OPERAND_ENDS else "the quoted name is not ended",
        "\\": "this LaTeX command has no meaning here",
        "$": "parameters such as $1 stand only among the arguments of a proposition",
        **dict.fromkeys("“”‘’'`", 'names are quoted with straight double quotes: "H&M"'),
    }
    if sign == "," and not (reading.open_brackets and reading.open_brackets[-1].arguments):
        return "only arguments are listed with commas; a function named like an operator is quoted"
    return hints.get(sign, "")


def _name_hint(reading: Reading, position: int, sign: str) -> str:
    """For what looks like the middle of a name."""
    touching = position > 0 and not reading.text[position - 1].isspace()
    in_arguments = bool(reading.open_brackets) and reading.open_brackets[-1].arguments
    after_name = reading.last is not None and reading.last.type in ("NAME", "WORD")
    if after_name and (touching or (in_arguments and (sign.isalnum() or not sign.isascii()))):
        return "a name with other characters than letters, digits and _ is quoted"
    return ""
