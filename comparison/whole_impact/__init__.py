"""The whole impact, from the first touch to the last separation: what a run gives, bands, the map, and where the
infinite beam's law ends."""
