//! What was computed for the settings before: who goes back to one of them has it at once.

/// Settings that are kept, beside the one that is shown.
const MOST: usize = 3;

/// Runs that were shown before, the last one last.
#[derive(Clone, Debug)]
pub struct Kept<T>(Vec<T>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Kept<T> {
    /// Keeps a run that is shown no more, and forgets the one that was left the longest time ago where there are too many.
    pub fn put(&mut self, run: T) {
        if self.0.len() == MOST {
            self.0.remove(0);
        }
        self.0.push(run);
    }

    /// Shows another run in the place of one, which is kept where there was anything to be seen of it.
    pub fn show(&mut self, shown: &mut T, run: T, was_seen: impl FnOnce(&T) -> bool) {
        let before = core::mem::replace(shown, run);
        if was_seen(&before) {
            self.put(before);
        }
    }

    /// Takes the run out for which this holds, if there is one.
    pub fn take(&mut self, is: impl FnMut(&T) -> bool) -> Option<T> {
        let found = self.0.iter().position(is)?;
        Some(self.0.remove(found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_few_are_kept_and_each_is_given_back_once() {
        let mut kept = Kept::default();
        (1..=5).for_each(|run| kept.put(run));
        assert_eq!(kept.take(|run| *run == 2), None, "it was forgotten");
        assert_eq!(kept.take(|run| *run == 4), Some(4));
        assert_eq!(kept.take(|run| *run == 4), None);
        kept.put(4);
        assert_eq!((kept.take(|run| *run == 3), kept.take(|run| *run == 5)), (Some(3), Some(5)));
    }
}
