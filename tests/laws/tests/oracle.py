"""The ancestors that the package `particles` draws from given weights and given uniforms.

Reads lines `scheme n weights uniforms` (numbers separated by commas) and writes a line of sorted ancestors for each. The package
draws its randomness by numpy's random.rand: that alone is replaced, by the uniforms given.
"""

import sys

import numpy as np
from particles import resampling

given = None


def rand(count):
    # Its multinomial scheme makes sorted uniforms of count - 1 from so many exponential spacings, -log(rand).
    if scheme in ("multinomial", "residual"):
        uniforms = np.sort(given[: count - 1])
        return np.exp(-np.diff(np.concatenate(([0.0], uniforms, [1.0]))))
    return given[:count]


resampling.random.rand = rand
for line in sys.stdin:
    scheme, n, weights, given = line.split()
    weights, given = (np.array([float(x) for x in part.split(",")]) for part in (weights, given))
    ancestors = getattr(resampling, scheme)(weights, M=int(n))
    print(" ".join(str(slot) for slot in sorted(ancestors)))
