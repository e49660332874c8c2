"""Rows that arrive block by block, gathered in one array: joined at the end they would be held twice."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats


class Growing:
    """A table of floats, (n, width), that grows in place by an eighth of itself."""

    def __init__(self, width: int) -> None:
        self._table = np.empty((0, width))
        self._n_rows = 0

    def add(self, rows: Floats) -> None:
        """Append rows, (n, width)."""
        stop = self._n_rows + len(rows)
        if stop > len(self._table):
            self._resize(max(stop, self._n_rows + self._n_rows // 8))
        self._table[self._n_rows : stop] = rows
        self._n_rows = stop

    def taken(self) -> Floats:
        """Return the rows, (n, width), which are this table's no more: it is empty again.

        >>> table = Growing(2)
        >>> table.add(np.array([[1.0, 2.0]])); table.add(np.array([[3.0, 4.0]])); table.taken().tolist()
        [[1.0, 2.0], [3.0, 4.0]]
        """
        self._resize(self._n_rows)
        table, self._n_rows = self._table, 0
        self._table = np.empty((0, table.shape[1]))
        return table

    def _resize(self, n_rows: int) -> None:
        self._table.resize((n_rows, self._table.shape[1]), refcheck=False)  # no view of it is handed out
