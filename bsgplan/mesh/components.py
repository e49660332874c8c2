"""Connected components of a graph, whatever its nodes are: cells, corners, boundary fans."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Ints


def connected_labels(links: Ints, n_nodes: int) -> Ints:
    """Return the component of each node of a graph, (n_nodes,), from 0, numbered by their first nodes."""
    graph = coo_array(
        (np.ones(len(links), dtype=np.int8), (links[:, 0], links[:, 1])), shape=(n_nodes, n_nodes)
    )
    return connected_components(graph, directed=False)[1].astype(np.int64)
