# SPDX-License-Identifier: MIT
"""Sets of row numbers."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from foparq.columns import union

ROWS = st.lists(st.lists(st.integers(-1, 30), max_size=20), max_size=4)


@given(ROWS)
def test_a_union_is_that_of_sets_in_order(columns: list[list[int]]) -> None:
    assert union(*(np.array(rows, dtype=np.intp) for rows in columns)).tolist() == sorted(
        {row for rows in columns for row in rows}
    )
