"""The sintering study: its runs, what is measured of them, and the table and figures that stand beside the paper.

The physics is that of S. Luding, K. Manetsberger and J. Müllers, *A discrete model for long time sintering*, J. Mech.
Phys. Solids 53 (2005) 455. What is measured and how to read the table: docs/sintering.md.
"""
