//! The same bits in every build: see `tests/`.
