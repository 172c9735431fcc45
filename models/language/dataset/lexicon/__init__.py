"""Open words: names of things outside the vocabularies of the datasets, in a part for training and one held out."""

from models.language.dataset.lexicon.lists import OpenWords, open_words

__all__ = ["OpenWords", "open_words"]
