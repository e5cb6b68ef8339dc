//! Who computes: one map over the slots of a population, serial or on threads. The results never differ.

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
    /// rayon where feature `parallel` is on and `single-threaded` is not.
    fn default() -> Self {
        #[cfg(all(feature = "parallel", not(feature = "single-threaded")))]
        return Self::Rayon;
        #[cfg(not(all(feature = "parallel", not(feature = "single-threaded"))))]
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
