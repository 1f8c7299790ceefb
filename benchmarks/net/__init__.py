"""The net: answers of a known commit that a rewrite of the solver has to give again."""
