"""bsgplan: the planner for block-structured triangular grids."""
