"""The predictor: theory in one web page that needs no server and no network."""
