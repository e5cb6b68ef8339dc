//! The shortest figure: recipe, model and view in one, for what has no state besides its parameters.

use crate::{
    challenge::Challenge,
    model::{Change, Declared, FigureError, Model, Readout, Tells},
    panels::Panels,
    recipe::Recipe,
    scene::{Rect, Scene, Stack},
    view::{Layout, View},
};
use core::marker::PhantomData;

/// A recipe of which every row of the table holds one field: the struct, its defaults and the table in one. A field is written as
/// `name: type = default, kind(…), help;`, where `kind` makes a [`crate::recipe::Param`] of what is in the brackets, of the field and of its help; further
/// words, as `in_sight()`, are calls on that.
///
/// ```
/// use fastslam_figures_kit::{recipe, recipe::values};
///
/// recipe! {
///     struct Walk {
///         steps: u32 = 3, integer("steps", "Steps", "", (0, 9)), "How far it goes.", in_sight();
///     }
/// }
///
/// assert_eq!(values(&Walk::default()), [("steps", "3".to_owned())]);
/// ```
#[macro_export]
macro_rules! recipe {
    ($(#[$of:meta])* $visible:vis struct $name:ident {$(
        $field:ident: $type:ty = $default:expr, $kind:ident($($with:expr),*), $help:expr $(, $more:ident($($how:expr),*))*;
    )*}) => {
        $(#[$of])*
        #[derive(Clone, PartialEq)]
        $visible struct $name {
            $(pub(crate) $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $crate::recipe::Recipe for $name {
            fn table() -> Vec<$crate::recipe::Param<Self>> {
                vec![$($crate::recipe::Param::<Self>::$kind($($with,)* $crate::field!($field), $help)$(.$more($($how),*))*,)*]
            }
        }
    };
}

/// A figure that is a function of its parameters. One that simulates has a [`Model`] and a [`View`] of its own.
pub trait Sketch: Recipe {
    /// Title for readers.
    const TITLE: &'static str;

    /// [`Declared::CHANGES`].
    const CHANGES: &'static [Change] = &[];

    /// Names of its panels from top to bottom, by which a page can show them alone; none for a picture of one piece.
    const PANELS: &'static [&'static str] = &[];

    /// Height \[css px\] of a panel in a figure of this width.
    fn height(_panel: &str, width: f64) -> f64 {
        0.6 * width
    }

    /// States that are worth trying, in the order in which they are offered.
    fn challenges() -> Vec<Challenge<Self>> {
        Vec::new()
    }

    /// The numbers of the state shown.
    fn readouts(&self) -> Vec<Readout>;

    /// One or two sentences that tell what is shown now.
    fn describe(&self) -> String;

    /// Draws a panel into its area.
    fn draw(&self, panel: &str, area: Rect, scene: &mut Scene);
}

impl<S: Sketch> Declared for S {
    type Recipe = S;
    const TITLE: &'static str = <S as Sketch>::TITLE;
    const CHANGES: &'static [Change] = <S as Sketch>::CHANGES;

    fn recipe(&self) -> &S {
        self
    }

    fn adopt(&mut self, recipe: S) -> Result<(), FigureError> {
        *self = recipe;
        Ok(())
    }
}

impl<S: Sketch> Tells for S {
    fn challenges() -> Vec<Challenge<S>> {
        <S as Sketch>::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        Sketch::readouts(self)
    }

    fn describe(&self) -> String {
        Sketch::describe(self)
    }
}

impl<S: Sketch> Model for S {}

/// The panels of a sketch one below the other, each over the whole width.
pub struct Column<S>(Vec<(&'static str, Rect)>, PhantomData<S>);

/// Between two panels \[css px\].
const GAP: f64 = 8.0;

impl<S: Sketch> Layout for Column<S> {
    const PANELS: &'static [&'static str] = S::PANELS;

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let mut stack = Stack::new(0.0, width);
        let names = if S::PANELS.is_empty() { &[""] } else { S::PANELS };
        let places = names.iter().map(|name| (*name, stack.take(panels.has(name), S::height(name, width), GAP)));
        Self(places.collect(), PhantomData)
    }

    fn height(&self) -> f64 {
        self.0.iter().filter(|(_, area)| area.h > 0.0).map(|(_, area)| area.bottom()).fold(0.0, f64::max)
    }
}

impl<S: Sketch> View for S {
    type Model = S;
    type Layout = Column<S>;

    fn draw(&self, model: &S, Column(places, _): &Column<S>, scene: &mut Scene) {
        for (panel, area) in places.iter().filter(|(_, area)| area.h > 0.0) {
            Sketch::draw(model, panel, *area, scene);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{figure::Figure, scene::Role};

    recipe! {
        struct Bars {
            long: u32 = 60, integer("long", "Long", "px", (0, 90)), "How long the bar is.", in_sight();
        }
    }

    impl Sketch for Bars {
        const TITLE: &'static str = "Bars";
        const PANELS: &'static [&'static str] = &["upper", "lower"];

        fn height(panel: &str, _: f64) -> f64 {
            if panel == "upper" { 30.0 } else { 20.0 }
        }

        fn readouts(&self) -> Vec<Readout> {
            vec![Readout::new("long", "Long", self.long.into(), self.long.to_string(), "px", "")]
        }

        fn describe(&self) -> String {
            format!("{} px.", self.long)
        }

        fn draw(&self, _: &str, area: Rect, scene: &mut Scene) {
            scene.fill(Rect { w: self.long.into(), ..area }, Role::Ink);
        }
    }

    #[test]
    fn panels_stand_one_below_the_other_and_the_one_that_is_asked_for_stands_alone() {
        let mut figure = Figure::of::<Bars>("bars");
        let shown = |figure: &Figure| (figure.height(300.0), figure.scene(300.0, 0.0).marks.len());
        assert_eq!((figure.panels(), shown(&figure)), (["upper", "lower"].as_slice(), (58.0, 2)));
        figure.show("lower").unwrap();
        assert_eq!(shown(&figure), (20.0, 1));
    }

    #[test]
    fn a_recipe_is_written_once_and_its_default_is_the_state_of_a_figure_of_which_nothing_was_asked() {
        let mut figure = Figure::of::<Bars>("bars");
        let [spec] = &figure.params()[..] else { panic!("one row") };
        assert_eq!((spec.name, spec.default.as_str(), spec.max, spec.sight), ("long", "60", 90.0, true));
        assert_eq!((figure.load("long=20"), figure.describe()), (vec![], "20 px.".into()));
    }
}
