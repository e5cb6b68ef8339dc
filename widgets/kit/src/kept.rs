//! What is computed for a setting: the run that is shown, the one that was asked for since, and those of the settings before, so that who goes
//! back to one of them has it at once.

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

    /// Takes the run out for which this holds, if there is one.
    pub fn take(&mut self, is: impl FnMut(&T) -> bool) -> Option<T> {
        let found = self.0.iter().position(is)?;
        Some(self.0.remove(found))
    }
}

/// A figure that computes a run for each setup, a slice at a time.
pub trait Computes {
    /// What is computed.
    type Run;
    /// All that it depends on.
    type Setup: PartialEq;

    /// The setup that a run was begun with.
    fn setup(run: &Self::Run) -> &Self::Setup;

    /// Whether there is anything to be seen of it.
    fn is_begun(run: &Self::Run) -> bool;

    /// Whether so much of it is there that who goes back to it is glad to have it at once.
    fn is_worth_keeping(run: &Self::Run) -> bool {
        Self::is_begun(run)
    }

    /// Forgets what only a run that goes on needs.
    fn put_aside(_run: &mut Self::Run) {}
}

/// The runs of a figure: one is shown, and stays until there is anything to be seen of the one that was asked for since.
pub struct Runs<F: Computes> {
    shown: F::Run,
    /// What was asked for since.
    next: Option<F::Run>,
    kept: Kept<F::Run>,
}

impl<F: Computes> Runs<F> {
    /// The first run, which is shown from its beginning.
    pub fn new(shown: F::Run) -> Self {
        Self { shown, next: None, kept: Kept::default() }
    }

    /// The run that is shown.
    pub fn shown(&self) -> &F::Run {
        &self.shown
    }

    /// The run that was asked for last, whether it is shown or not.
    pub fn asked(&self) -> &F::Run {
        self.next.as_ref().unwrap_or(&self.shown)
    }

    /// The same, to go on with it.
    pub fn asked_mut(&mut self) -> &mut F::Run {
        self.next.as_mut().unwrap_or(&mut self.shown)
    }

    /// Whether what is shown is what was asked for, and not only its beginning.
    pub fn refines(&self) -> bool {
        self.next.is_none() && F::is_begun(&self.shown)
    }

    /// Asks for the run of a setup. One that is kept is shown at once, and one that is shown goes on; any other is begun, near a run that this
    /// prefers to the one that is shown. Returns whether another run is shown now.
    pub fn ask<E>(
        &mut self,
        setup: &F::Setup,
        prefers: impl FnOnce(&F::Run) -> bool,
        begin: impl FnOnce(&F::Run) -> Result<F::Run, E>,
    ) -> Result<bool, E> {
        if setup == F::setup(self.asked()) {
            return Ok(false);
        }
        let before = self.next.take();
        if let Some(kept) = self.kept.take(|run| F::setup(run) == setup) {
            self.show(kept);
            return Ok(true);
        }
        if setup != F::setup(&self.shown) {
            let nearest = before.as_ref().filter(|run| prefers(run)).unwrap_or(&self.shown);
            self.next = Some(begin(nearest)?);
        }
        Ok(false)
    }

    /// Shows the run that was asked for where this holds. Returns whether another run is shown now.
    pub fn show_if(&mut self, ready: impl FnOnce(&F::Run) -> bool) -> bool {
        let next = self.next.take_if(|next| ready(next));
        let shows = next.is_some();
        next.into_iter().for_each(|next| self.show(next));
        shows
    }

    fn show(&mut self, run: F::Run) {
        let mut before = core::mem::replace(&mut self.shown, run);
        if F::is_worth_keeping(&before) {
            F::put_aside(&mut before);
            self.kept.put(before);
        }
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

    /// A run of one number, with as much as is computed of it.
    struct Count(u32, u32);

    struct Counting;

    impl Computes for Counting {
        type Run = Count;
        type Setup = u32;

        fn setup(run: &Count) -> &u32 {
            &run.0
        }

        fn is_begun(run: &Count) -> bool {
            run.1 > 0
        }
    }

    #[test]
    fn a_run_is_shown_when_there_is_anything_to_be_seen_of_it_and_kept_for_who_goes_back() {
        let mut runs = Runs::<Counting>::new(Count(1, 3));
        let ask = |runs: &mut Runs<Counting>, setup: u32| {
            runs.ask(&setup, |_| true, |_| Ok::<_, ()>(Count(setup, 0))).unwrap()
        };
        assert!(!ask(&mut runs, 2) && runs.shown().0 == 1 && runs.asked().0 == 2 && !runs.refines());
        assert!(!runs.show_if(Counting::is_begun));
        runs.asked_mut().1 = 5;
        assert!(runs.show_if(Counting::is_begun) && runs.shown().0 == 2 && runs.refines());
        assert!(ask(&mut runs, 1), "it was kept");
        assert_eq!((runs.shown().0, runs.shown().1), (1, 3));
        ask(&mut runs, 7);
        ask(&mut runs, 1);
        assert!(runs.refines(), "what was asked for in between is given up");
    }

    #[test]
    fn another_run_is_begun_near_the_one_asked_for_before_where_that_is_preferred() {
        for (prefers, near) in [(true, 2), (false, 1)] {
            let mut runs = Runs::<Counting>::new(Count(1, 1));
            let mut begun = Vec::new();
            for setup in [2, 3] {
                let begin = |nearest: &Count| {
                    begun.push(nearest.0);
                    Ok::<_, ()>(Count(setup, 0))
                };
                runs.ask(&setup, |_| prefers, begin).unwrap();
            }
            assert_eq!(begun, [1, near]);
        }
    }
}
