//! What a figure is to everyone else: a deterministic state that parameters change and readouts describe.
//!
//! A model has no clock and no frame time. Its state is a function of the *recipe*, the values of its parameters, so that a
//! link, a saved figure and a replay are the same thing. Long computations are cut into steps: [`Model::seek`] says what is
//! asked for, [`Model::pending`] how far that is away, and [`Model::work`] goes one step nearer.

use crate::challenge::{Challenge, Chip};
pub use crate::error::FigureError;
use crate::ghost::Curves;
pub use crate::measured::{Column, Readout, Series, TraceLine};
pub use crate::param::{Choice, Group, Kind, ParamSpec};
use crate::prediction::Outcome;
use crate::recipe::{self, Recipe};

/// What makes a version of a figure another one than the version before, for links.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Change {
    /// Older links show something else now: a sentence says what.
    Told(&'static str),
    /// The same for those links only in which a parameter has this number.
    ToldAt {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The sentence.
        change: &'static str,
    },
    /// A parameter has another default. An older link that does not name it means the value that was the default then, and shows the same.
    Default {
        /// The parameter.
        name: &'static str,
        /// The default before.
        was: &'static str,
    },
    /// The same, but for those links that give another parameter a value of its own.
    DefaultUnless {
        /// The parameter.
        name: &'static str,
        /// The default before.
        was: &'static str,
        /// The other parameter, and the value with which nothing has changed.
        unless: (&'static str, &'static str),
    },
    /// Opens at its telling step where nothing is to move and on paper: before, at its first. A link shows what it did.
    Opens,
    /// Changes for those links only that switch a parameter on.
    Switched {
        /// The parameter.
        name: &'static str,
        /// What has changed for them.
        changes: &'static [Change],
    },
}

/// A model that has a recipe. It is all that a figure writes of its parameters besides their table: [`Parameters`] follows.
pub trait Declared {
    /// Everything that a link says.
    type Recipe: Recipe;

    /// Title for readers.
    const TITLE: &'static str;

    /// What has changed for those who made links, for each version of the figure from the second on. A change of a default, of what a
    /// parameter means, or of the numbers is one.
    const CHANGES: &'static [Change] = &[];

    /// Version of the figure that a pasted code means which says none: the newest one of the day on which codes began to say theirs, and 1
    /// for figures that are younger. It never changes: it is what keeps older pages as they are.
    const UNSAID: usize = 1;

    /// What it is made by.
    fn recipe(&self) -> &Self::Recipe;

    /// Becomes what another recipe says, and simulates anew only what that changes.
    ///
    /// # Errors
    /// Where what goes on inside refuses a value; all is as it was.
    fn adopt(&mut self, recipe: Self::Recipe) -> Result<(), FigureError>;

    /// Changes the recipe by hand. Numbers end in their ranges, so that there is nothing to refuse.
    fn change(&mut self, change: impl FnOnce(&mut Self::Recipe))
    where
        Self: Sized,
    {
        let mut recipe = self.recipe().clone();
        change(&mut recipe);
        recipe.follow(self.recipe());
        let _ = self.adopt(recipe::confined(recipe));
    }
}

/// The title and the parameters of any model, by name and as text: what attributes, controls and links need.
pub trait Parameters {
    /// Title for readers.
    fn title(&self) -> &'static str;

    /// [`Declared::CHANGES`].
    fn changes(&self) -> &'static [Change];

    /// [`Declared::UNSAID`].
    fn unsaid(&self) -> usize;

    /// [`Tells::challenges`], and how it stands with them now.
    fn chips(&self) -> Vec<Chip>;

    /// All parameters with their ranges as they are now (the last step and the number of slots depend on the setup).
    fn params(&self) -> Vec<ParamSpec>;

    /// Current values of all parameters by name, as text that [`Parameters::configure`] takes.
    fn values(&self) -> Vec<(&'static str, String)>;

    /// Current value of a parameter; `None` for a name it does not know.
    fn value(&self, name: &str) -> Option<String> {
        named(self.values(), name)
    }

    /// Gives several parameters new values at once, rebuilding once. What is refused is returned and changes nothing; the
    /// rest is applied. Values of the setup come first, whatever their order.
    fn configure(&mut self, values: &[(String, String)]) -> Vec<FigureError>;

    /// The same from the defaults on: what is not named is the default again.
    fn load(&mut self, values: &[(String, String)]) -> Vec<FigureError>;
}

/// The value of a name; in a function of its own, as every figure asks for it.
fn named(values: Vec<(&'static str, String)>, name: &str) -> Option<String> {
    values.into_iter().find(|(known, _)| *known == name).map(|(_, value)| value)
}

/// What is told of the state shown, in numbers and in words, and of states that are worth trying.
pub trait Tells {
    /// States that are worth trying, in the order in which they are offered.
    fn challenges() -> Vec<Challenge<Self>>
    where
        Self: Sized,
    {
        Vec::new()
    }

    /// The numbers of the state shown.
    fn readouts(&self) -> Vec<Readout>;

    /// Measured data of every step simulated so far; of a figure without a timeline, one row: its readouts.
    fn series(&self) -> Series {
        let readouts = self.readouts();
        let columns = readouts.iter().map(|readout| Column::new(readout.name, readout.help)).collect();
        Series { columns, rows: vec![readouts.iter().map(|readout| readout.value.unwrap_or(f64::NAN)).collect()] }
    }

    /// One or two sentences that tell what is shown now, for who does not see it.
    fn describe(&self) -> String;

    /// What happens in the picture now, in a line in the words of its subject, with the one number that matters.
    fn narrate(&self) -> String {
        self.describe()
    }

    /// The lines of its algorithm that led to what is shown, in the order in which they ran. None before the first step.
    fn trace(&self) -> Vec<TraceLine> {
        Vec::new()
    }
}

/// A figure, without its pixels. One without a timeline leaves out everything about steps.
pub trait Model: Parameters + Tells {
    /// Asks for a step of the simulation; beyond the last means the last.
    fn seek(&mut self, _step: u32) {}

    /// Number of the last step; 0 for a figure without a timeline.
    fn step_count(&self) -> u32 {
        0
    }

    /// The step shown.
    fn step(&self) -> u32 {
        0
    }

    /// The step that tells most of what the figure is about: what is shown where nothing is to move, on paper and in pictures of it, and
    /// where a reader who is still at the first step changes what is simulated. 0 for a figure without a timeline.
    fn telling(&self) -> u32 {
        0
    }

    /// What is to be watched of it until its end, in a few words that ask for it, and the step before it.
    fn watch(&self) -> Option<(u32, &'static str)> {
        None
    }

    /// Steps of simulation between what is shown and what was asked for.
    fn pending(&self) -> u32 {
        0
    }

    /// Does one of the pending steps.
    fn work(&mut self) {}

    /// Whether the pending steps are so much work that another program is worth asking for a part of each.
    fn shares(&self) -> bool {
        false
    }

    /// One of the two parts of the work that the next step is made of, 0 or 1, as numbers for [`Self::work_with`]: the same in every program that
    /// is at this step of this recipe.
    fn part(&self, _part: usize) -> Vec<f64> {
        Vec::new()
    }

    /// Does one of the pending steps, of which these parts are known. Parts of another step are of no use, and change nothing.
    fn work_with(&mut self, _parts: [&[f64]; 2]) {
        self.work();
    }

    /// What comes of the reader's prediction, if one is asked for.
    fn prediction(&self) -> Option<Outcome> {
        None
    }

    /// How fast the step shown is played, of the usual speed: below 1 where there is much to see in it.
    fn pace(&self) -> f64 {
        1.0
    }

    /// A parameter whose control shows another value than was set, and that value: what is shown is of it.
    fn instead(&self) -> Option<(&'static str, String)> {
        None
    }

    /// Names of the readouts that tell most of what is shown, the one that matters first.
    fn compared(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// Curves of all that was simulated, for another run to be compared with; none of a figure that has none.
    fn curves(&self) -> Curves {
        Curves::new()
    }

    /// Draws these curves of another run behind its own, whatever is set, until there are none.
    fn haunt(&mut self, _pinned: Curves) {}

    /// What it does with files, if it takes or makes any.
    fn files(&self) -> Option<&dyn Files> {
        None
    }

    /// The same, to be given one.
    fn files_mut(&mut self) -> Option<&mut dyn Files> {
        None
    }

    /// What is shown while something is pending. 0: what was asked for before, so that a page holds its picture until all is done. Any other
    /// number: an answer to what was asked for, to which only something is added; a greater one is worth a picture as soon as it is there.
    fn answer(&self) -> u32 {
        0
    }

    /// Does all pending work.
    fn settle(&mut self) {
        while self.pending() > 0 {
            self.work();
        }
    }
}

/// What a model does with files.
pub trait Files {
    /// Takes a reader's file instead of the one before.
    ///
    /// # Errors
    /// For a file that cannot be read; the model is as it was.
    fn open(&mut self, file: &[u8]) -> Result<(), FigureError>;

    /// Takes what another program of ours has read of a reader's file, as it hands it over. A reader's own bytes never come here.
    ///
    /// # Errors
    /// For what cannot be used; the model is as it was.
    fn take(&mut self, read: &[u8]) -> Result<(), FigureError>;

    /// Whether what was set can be computed at all: asked before a computation that takes long.
    ///
    /// # Errors
    /// The parameter that stands in the way, and its range.
    fn ready(&self) -> Result<(), FigureError>;

    /// A file of this name made of the state shown, if there is such a one.
    fn file(&self, name: &str) -> Option<Vec<u8>>;
}
