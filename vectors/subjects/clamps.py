#!/usr/bin/env python3
"""bezier.py with a mistake that is often made: arguments outside of the domain are brought to its nearer end.
`evalcts vectors check` finds it."""
import bezier

bernstein = bezier.bernstein
bezier.bernstein = lambda values, t: bernstein(values, min(max(t, 0), 1))
bezier.main()
