"""Recomputes the golden vectors from their inputs, with integers and fractions only."""
