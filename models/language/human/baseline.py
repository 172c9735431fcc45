"""What the networks are compared with: a linear classifier of lifted sentences, which knows no word but those it saw.

The things that a sentence names are masked by kind in the order in which they are named; the classes are formulas whose
things are numbered in that order. So the classifier chooses template and arguments at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

from sklearn.feature_extraction.text import TfidfVectorizer
from sklearn.pipeline import make_pipeline
from sklearn.svm import LinearSVC

from models.language.human.environment import Environment, Sentence
from models.language.human.lifting import Lifted, fill

NGRAMS = (1, 3)


@dataclass(frozen=True, slots=True, eq=False)
class LinearBaseline:
    """TF-IDF of words and their neighbours, and a linear support vector machine with scikit-learn's settings."""

    classifier: Any
    environment: Environment

    @classmethod
    def fit(cls, commands: Sequence[Lifted], environment: Environment) -> Self:
        """Learn from lifted commands."""
        vectors = TfidfVectorizer(token_pattern=r"\S+", ngram_range=NGRAMS, lowercase=False)
        classifier = make_pipeline(vectors, LinearSVC(random_state=0))
        texts = [masked(command.sentence, environment) for command in commands]
        classifier.fit(texts, [_class(command) for command in commands])
        return cls(classifier, environment)

    def formulas(self, sentences: Sequence[Sentence]) -> list[str]:
        """The formula of each sentence; empty when it has too few things for the class."""
        classes = self.classifier.predict([masked(sentence, self.environment) for sentence in sentences])
        return [_filled(str(name), sentence) for name, sentence in zip(classes, sentences, strict=True)]


def masked(sentence: Sentence, environment: Environment) -> str:
    """The sentence with a word like `room1` for each name, numbered by thing in the order of mention."""
    kinds = environment.kind_of
    order = named(sentence)
    marks = {thing: (f"{kinds[thing]}{number}",) for number, thing in enumerate(order, start=1)}
    return " ".join(sentence.renamed(marks).words)


def named(sentence: Sentence) -> list[str]:
    """The things that a sentence names, in the order of mention."""
    return list(dict.fromkeys(name.thing for name in sentence.names))


def _class(command: Lifted) -> str:
    """The formula with its things numbered in the order of mention."""
    order = named(command.sentence)
    return fill(command.template, [f"${order.index(thing) + 1}" for thing in command.things])


def _filled(name: str, sentence: Sentence) -> str:
    try:
        return fill(name, named(sentence))
    except IndexError:
        return ""
