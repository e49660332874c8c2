"""The theory of transitions between fronts: no mesh in here."""
