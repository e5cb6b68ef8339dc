//! Parts of a layout below each other.

use super::Rect;

/// What is left of a column below what was placed in it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stack {
    /// Left edge \[css px\].
    pub x: f64,
    /// Where the next part begins \[css px\].
    pub y: f64,
    /// Width \[css px\].
    pub w: f64,
}

impl Stack {
    /// An empty column from the upper edge of the figure on.
    pub fn new(x: f64, w: f64) -> Self {
        Self { x, y: 0.0, w }
    }

    /// The next part, and a gap below it; one that is not shown takes no height.
    pub fn take(&mut self, shown: bool, h: f64, gap: f64) -> Rect {
        let (h, gap) = if shown { (h, gap) } else { (0.0, 0.0) };
        let part = Rect::new(self.x, self.y, self.w, h);
        self.y = part.bottom() + gap;
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_below_each_other_and_those_that_are_not_shown_take_no_room() {
        let mut stack = Stack::new(10.0, 100.0);
        let parts = [(true, 20.0), (false, 30.0), (true, 40.0)].map(|(shown, h)| stack.take(shown, h, 5.0));
        assert_eq!(parts.map(|part| (part.y, part.h)), [(0.0, 20.0), (25.0, 0.0), (25.0, 40.0)]);
        assert!(parts.iter().all(|part| (part.x, part.w) == (10.0, 100.0)));
    }
}
