//! What can be asked of a figure: by its reader's hand, by the page around it and by that page's author. It is the only way in from the
//! browser, where an [`Action`] comes as a flat object, `{ do: 'drag', name: 'r2', at: [30, 40] }`: its shapes are told to TypeScript in
//! `elements/action.ts`, and a test holds the two together.

use crate::paint::Theme;

/// One thing that is asked. Points and lengths are in css px of the canvas.
#[derive(Clone, PartialEq, Debug)]
pub enum Action {
    /// What the page's author gave, as a code has it, with `v`, of which version that is: what is left out or taken away is at the default
    /// of that version.
    Author(String),
    /// Begins, or begins anew.
    Begin(Beginning),
    /// Gives a parameter a value.
    Set {
        /// Which one.
        name: String,
        /// As a link has it; `None` for the default.
        value: Option<String>,
        /// Whether a reader does it: what was set before is then compared with it.
        hand: bool,
    },
    /// Names parameters that readers may not change, apart by spaces, or `all`.
    Lock(String),
    /// Shows some parts of the picture ([`crate::figure::Figure::show`]).
    Show(String),
    /// Speaks a language ([`crate::figure::Figure::set_words`]).
    Words(String),
    /// Writes numbers with a decimal comma.
    Comma(bool),
    /// Lights a symbol wherever the picture writes it; an empty one puts it out.
    Light(String),
    /// Compares the setting before with that of now, or does not.
    Compare(bool),
    /// Goes to a step; one beyond the last is the last.
    Seek(f64),
    /// Goes to the step that tells most, if there is such a one.
    Tell,
    /// Tells in the next frame the lines of the algorithm that have run.
    Trace,
    /// Has the pointer go: what has only followed it goes back to where it was.
    Leave,
    /// Is shown at a size.
    Size(Size),
    /// Is touched.
    Touch(Touch),
}

/// What a reader's pointer or keys do to the picture.
#[derive(Clone, PartialEq, Debug)]
pub enum Touch {
    /// A click.
    Pick([f64; 2]),
    /// A handle ([`crate::scene::Handle::name`]) is moved to a point.
    Drag(String, [f64; 2]),
    /// A pointer passes over an area: the handle goes along, until the pointer leaves.
    Follow(String, [f64; 2]),
    /// A handle is moved right and up, by steps of its parameters.
    Nudge(String, [f64; 2]),
    /// What only its kind of figure can do.
    Own(Own),
}

/// What only one kind of figure can do, as it comes over the boundary: its view knows it as its own type.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Own {
    /// What is done.
    pub name: String,
    /// With what.
    pub with: String,
    /// Where, or by how much.
    pub at: Vec<f64>,
}

/// The state that a figure begins with.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Beginning {
    /// As a link has it; `None` for the defaults.
    pub query: Option<String>,
    /// What is set after that, as a link has it; a name without a value is the default.
    pub settings: String,
    /// Whether the query is a reader's link: locked parameters keep what the author gave.
    pub linked: bool,
    /// Whether that is told as a change.
    pub changed: bool,
}

/// Where the picture goes, and how it is to look.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Size {
    /// Width for the picture \[css px\].
    pub room: f64,
    /// Most height for the picture \[css px\]; where it would be higher, it does not take all of the width.
    pub height: f64,
    /// Letters and lines over normal ones.
    pub font_scale: f64,
    /// Width of the canvas on the page \[css px\].
    pub css: f64,
    /// Width and height of the canvas \[device px\].
    pub px: [u32; 2],
    /// Its colours.
    pub theme: Theme,
}

/// An action as it comes over the boundary: flat, as that is the least to read.
#[derive(Default)]
#[cfg_attr(test, derive(serde::Serialize, serde::Deserialize), serde(default))]
pub struct Message {
    /// What is asked.
    pub r#do: String,
    /// Of which parameter, handle, language, theme …
    pub name: String,
    /// A text that goes with it.
    pub value: Option<String>,
    /// A switch that goes with it.
    pub on: bool,
    /// Numbers that go with it.
    pub at: Vec<f64>,
}

impl TryFrom<Message> for Action {
    type Error = &'static str;

    fn try_from(message: Message) -> Result<Self, Self::Error> {
        let Message { r#do, name, value, on, at } = message;
        let number = |k: usize| at.get(k).copied().unwrap_or(f64::NAN);
        let point = [number(0), number(1)];
        Ok(match &*r#do {
            "author" => Self::Author(name),
            "begin" | "link" => {
                Self::Begin(Beginning { query: value, settings: name, linked: *r#do == *"link", changed: on })
            }
            "set" => Self::Set { name, value, hand: on },
            "lock" => Self::Lock(name),
            "show" => Self::Show(name),
            "words" => Self::Words(value.unwrap_or_default()),
            "comma" => Self::Comma(on),
            "light" => Self::Light(name),
            "compare" => Self::Compare(on),
            "seek" => Self::Seek(point[0]),
            "tell" => Self::Tell,
            "trace" => Self::Trace,
            "leave" => Self::Leave,
            "size" => Self::Size(Size {
                room: point[0],
                height: point[1],
                font_scale: number(2),
                css: number(3),
                px: [number(4) as u32, number(5) as u32],
                theme: Theme::named(&name),
            }),
            "pick" => Self::Touch(Touch::Pick(point)),
            "drag" => Self::Touch(Touch::Drag(name, point)),
            "follow" => Self::Touch(Touch::Follow(name, point)),
            "nudge" => Self::Touch(Touch::Nudge(name, point)),
            "own" => Self::Touch(Touch::Own(Own { name, with: value.unwrap_or_default(), at })),
            _ => return Err("no such action"),
        })
    }
}

#[cfg(test)]
mod tests;
