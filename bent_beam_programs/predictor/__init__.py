"""The predictor: one web page that simulates a beam and sets the theory beside it, without server or network."""
