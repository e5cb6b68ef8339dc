//! Who computes: one map over the slots of a population, serial or on threads. The results never differ.
//!
//! Feature `parallel`, which is on by default, compiles threads in. Features add up over a tree of dependencies, so whatever one crate
//! asks for must not take threads from another: natively they are the default wherever `parallel` is on. Feature
//! `single-threaded` speaks of WebAssembly alone, where a program that compiles threads in may still have to run on a page
//! without them: there it makes [`Executor::Serial`] the default. Each filter can be given the other executor.

/// Runs one function over all slots.
///
/// A closure sees its own slot only and the results come back in slot order, so both kinds give the same bits: everything
/// that depends on order (sums, argmax, resampling) is done afterwards, serially.
#[derive(Clone, Debug)]
pub enum Executor {
    /// One slot after the other on the calling thread.
    Serial,
    /// The current rayon thread pool.
    #[cfg(feature = "parallel")]
    Rayon,
}

impl Default for Executor {
    /// rayon where feature `parallel` is on; but on WebAssembly, with `single-threaded`, serial.
    fn default() -> Self {
        #[cfg(feature = "parallel")]
        if !cfg!(all(target_arch = "wasm32", feature = "single-threaded")) {
            return Self::Rayon;
        }
        Self::Serial
    }
}

impl Executor {
    /// `f(slot, &mut items[slot])` for every slot, results in slot order.
    pub fn map<T: Send, R: Send>(&self, items: &mut [T], f: impl Fn(usize, &mut T) -> R + Sync + Send) -> Vec<R> {
        match self {
            Self::Serial => items.iter_mut().enumerate().map(|(slot, item)| f(slot, item)).collect(),
            #[cfg(feature = "parallel")]
            Self::Rayon => {
                use rayon::prelude::*;
                items.par_iter_mut().enumerate().map(|(slot, item)| f(slot, item)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever else is on: `npm test` compiles the workspace with `single-threaded` as well, for the figures.
    #[test]
    #[cfg(not(target_arch = "wasm32"))]
    fn natively_threads_are_the_default_wherever_they_are_compiled_in() {
        let expected = if cfg!(feature = "parallel") { "Rayon" } else { "Serial" };
        assert_eq!(format!("{:?}", Executor::default()), expected);
    }
}
