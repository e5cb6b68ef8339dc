//! Laws across layers: see `tests/`.
