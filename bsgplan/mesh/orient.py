"""Which triangles to turn so that all of a mesh run the same way round.

In the plane the sign of the area tells, one triangle at a time. In space there is no sign: the way round is
handed on across edges, and each edge-connected component keeps the way of most of its triangles.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import InvalidMesh
from .components import connected_labels
from .quality import signed_areas
from .topology import topology


def turned_in_plane(points: Floats, triangles: Ints) -> Bools:
    """Return which triangles of the plane are clockwise, (n_triangles,).

    >>> turned_in_plane(np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1, 2], [0, 2, 1]]))
    array([False,  True])
    """
    return np.asarray(signed_areas(points, triangles) < 0)


def turned_in_space(triangles: Ints, n_points: int) -> Bools:
    """Return which triangles of a surface run against the others of their component, (n_triangles,).

    Each triangle stands on two sheets, as it is and turned over; an edge joins like sheets where its two
    triangles run along it in opposite directions, unlike ones elsewhere. A component whose two sheets
    hang together is one-sided. Raises InvalidMesh there, and as `topology` does.

    >>> turned_in_space(np.array([[0, 1, 2], [1, 2, 3], [0, 2, 4]]), 5)
    array([False,  True, False])
    """
    n = len(triangles)
    neighbours = topology(triangles, n_points)
    first, second = neighbours.neighbours.T
    is_unlike = neighbours.runs_alike
    links = np.concatenate(
        [
            np.column_stack([first, second + n * is_unlike]),
            np.column_stack([first + n, second + n * ~is_unlike]),
        ]
    )
    sheet, other = connected_labels(links, 2 * n).reshape(2, n)
    if (sheet == other).any():
        where = np.flatnonzero(sheet == other)
        raise InvalidMesh(
            f"the surface of triangle {where[0]} has one side only, as a Moebius strip "
            f"({len(where)} triangles); cut it open along a line of edges"
        )
    is_turned = sheet > other
    piece = np.minimum(sheet, other)
    majority = 2 * np.bincount(piece, is_turned) > np.bincount(piece)
    return np.asarray(is_turned ^ majority[piece])
