//! Where a recipe holds what a row of its table is about.

use super::held::Held;

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

/// A whole number of a recipe, whatever its type; all that parameters hold are below 2⁵³.
pub trait Whole: Sized {
    /// Where it is held.
    fn held<R>(field: Field<R, Self>) -> Held<R>;
}

macro_rules! whole {
    ($($type:ty: $held:ident)*) => { $(
        impl Whole for $type {
            fn held<R>(field: Field<R, Self>) -> Held<R> {
                Held::$held(field)
            }
        }
    )* };
}

whole!(u32: U32 u64: U64 usize: Usize);
