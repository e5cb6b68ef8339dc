//! Where a recipe holds what a row of its table is about.

/// A place in a recipe: how its value is read, and how it is written. [`crate::field!`] makes one of a path.
pub struct Field<R, T> {
    /// Its value.
    pub get: fn(&R) -> T,
    /// Gives it another.
    pub set: fn(&mut R, T),
}

/// The [`Field`] at a path of a recipe: `field!(setup.particles)`.
#[macro_export]
macro_rules! field {
    ($($path:tt)+) => {
        $crate::recipe::Field {
            get: |recipe| recipe.$($path)+,
            set: |recipe, value| recipe.$($path)+ = value,
        }
    };
}

/// A whole number of a recipe, whatever its type.
pub trait Whole: Copy + 'static {
    /// From a number that is whole and in its range.
    fn of(x: f64) -> Self;
    /// As a number: all that parameters hold are below 2⁵³.
    fn number(self) -> f64;
}

macro_rules! whole {
    ($($type:ty)*) => { $(
        impl Whole for $type {
            fn of(x: f64) -> Self {
                x as Self
            }
            fn number(self) -> f64 {
                self as f64
            }
        }
    )* };
}

whole!(u32 u64 usize);
