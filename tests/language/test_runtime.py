"""Networks as ONNX Runtime runs them, against NumPy."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from models.language.runtime import Graph


def test_a_network_computes_what_its_operators_say() -> None:
    generator = np.random.default_rng(0)
    weight, bias = (generator.normal(size=size).astype(np.float32) for size in ((2, 3), (2,)))
    graph = Graph()
    product = graph.linear("given", weight, bias)
    session = graph.session({"given": (np.float32, 3)}, [product, graph.node("Tanh", product)])
    batches = [generator.normal(size=(size, 4, 3)).astype(np.float32) for size in range(1, 5)]
    with ThreadPoolExecutor() as pool:  # it is asked by several threads at a time
        found = list(pool.map(lambda batch: session.run(given=batch), batches))
    for batch, (product_, tanh) in zip(batches, found, strict=True):
        np.testing.assert_allclose(product_, batch @ weight.T + bias, atol=1e-6)
        np.testing.assert_allclose(tanh, np.tanh(batch @ weight.T + bias), atol=1e-6)
