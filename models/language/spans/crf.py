"""A linear-chain conditional random field over the words of a text (Lafferty, McCallum, Pereira, ICML 2001).

Shapes: N texts, S words, L tags. Scores are logarithms and not normalised. A transition that must not be has
`FORBIDDEN`.
"""

from __future__ import annotations

import torch
from torch import Tensor


def log_partition(emissions: Tensor, transitions: Tensor, start: Tensor, lengths: Tensor) -> Tensor:
    """The logarithm of the summed exponentials of all tag sequences' scores, [N].

    Args:
        emissions: [N, S, L]; what lies beyond a text's length is ignored.
        transitions: [N, L, L], from the first tag to the second.
        start: [N, L], for the first word.
        lengths: [N], each at least 1.
    """
    alpha = start + emissions[:, 0]  # [N, L]
    for position in range(1, emissions.shape[1]):
        following = (alpha[:, :, None] + transitions).logsumexp(dim=1) + emissions[:, position]  # [N, L]
        alpha = torch.where((position < lengths)[:, None], following, alpha)
    return alpha.logsumexp(dim=1)


def score(emissions: Tensor, transitions: Tensor, start: Tensor, lengths: Tensor, tags: Tensor) -> Tensor:
    """The scores [N] of the tag sequences `tags` [N, S]; other arguments as `log_partition`."""
    count = emissions.shape[1]
    said = emissions.gather(2, tags[:, :, None]).squeeze(2)  # [N, S]
    rows = torch.arange(len(tags))[:, None]  # [N, 1]
    moves = transitions[rows, tags[:, :-1], tags[:, 1:]]  # [N, S - 1]
    here = torch.arange(count) < lengths[:, None]  # [N, S]
    return start.gather(1, tags[:, :1]).squeeze(1) + (said * here).sum(dim=1) + (moves * here[:, 1:]).sum(dim=1)  # [N]
