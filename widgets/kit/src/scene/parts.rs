//! What a layout is made of: every part that has a place, without a list of them by hand.

use super::Rect;
use crate::{panels::Panels, view::Layout};

/// Places of a picture: of a part, of some, or of a whole layout.
pub trait Parts {
    /// Adds those that it has: none, unless it says so. What is not shown has no height.
    fn add_to(&self, _places: &mut Vec<Rect>) {}

    /// All of them.
    fn parts(&self) -> Vec<Rect> {
        let mut places = Vec::new();
        self.add_to(&mut places);
        places
    }

    /// The lower edge of the lowest that is shown \[css px\].
    fn lowest(&self) -> f64 {
        self.parts().iter().filter(|part| part.h > 0.0).map(Rect::bottom).fold(0.0, f64::max)
    }
}

impl Parts for Rect {
    fn add_to(&self, places: &mut Vec<Rect>) {
        places.push(*self);
    }
}

impl<T: Parts> Parts for Vec<T> {
    fn add_to(&self, places: &mut Vec<Rect>) {
        self.iter().for_each(|part| part.add_to(places));
    }
}

impl<T: Parts, const N: usize> Parts for [T; N] {
    fn add_to(&self, places: &mut Vec<Rect>) {
        self.iter().for_each(|part| part.add_to(places));
    }
}

impl<T: Parts> Parts for Option<T> {
    fn add_to(&self, places: &mut Vec<Rect>) {
        self.iter().for_each(|part| part.add_to(places));
    }
}

impl Parts for f64 {}
impl Parts for bool {}
impl Parts for Panels {}

/// A struct of places.
#[macro_export]
macro_rules! parts {
    ($(#[$doc:meta])* pub struct $name:ident { $($(#[$of:meta])* pub $part:ident: $type:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, PartialEq, Debug)]
        pub struct $name { $($(#[$of])* pub $part: $type,)* }

        impl $crate::scene::Parts for $name {
            fn add_to(&self, places: &mut Vec<$crate::scene::Rect>) {
                $($crate::scene::Parts::add_to(&self.$part, places);)*
            }
        }
    };
}

/// That of each choice of panels, at every width from the least on, as many parts as are told lie inside of the figure and nowhere over each
/// other, and at most this much is left free around them \[css px\].
pub fn assert_laid_out<L: Parts + Layout>(choices: &[(&str, usize)], free: f64) {
    for (choice, count) in choices {
        let panels = Panels::named(choice, L::PANELS).unwrap();
        for width in (L::NARROWEST as u32..2000).step_by(7).map(f64::from) {
            let layout = L::of(width, &panels);
            let parts: Vec<Rect> = layout.parts().into_iter().filter(|part| part.h > 0.0).collect();
            assert_eq!(parts.len(), *count, "{choice} at {width}");
            super::assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height()));
            assert!(layout.height() - layout.lowest() <= free, "{choice} at {width}: nothing is left below");
            assert!(parts.iter().any(|part| part.y <= free), "{choice} at {width}: nothing is left above");
        }
    }
}

/// That the whole is no higher at these widths than told \[css px\]: the chapter on a laptop and in its narrowest column, a phone, a tablet,
/// the whole of a 16:9 screen, each with the controls that belong to it.
pub fn assert_on_screens<L: Layout>(screens: &[(f64, f64)]) {
    for (width, most) in screens {
        let height = L::new(*width).height();
        assert!(height <= *most, "{width}: {height}");
    }
}
