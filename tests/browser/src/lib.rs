//! Nothing but tests, run in a browser by `wasm-pack test --headless --chrome tests/browser`.
