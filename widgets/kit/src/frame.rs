//! All that a figure tells the page of itself: a [`State`] whenever it is asked, and a [`Frame`] with every picture.

use crate::{
    challenge::Chip,
    export::Entries,
    model::{FigureError, ParamSpec, Readout, TraceLine},
    prediction::Outcome,
    scene::{Rect, Room},
};
use serde::Serialize;

/// What is set, and how far it is computed.
#[derive(Serialize)]
pub struct State {
    /// Current values by name.
    pub values: Entries<String>,
    /// The link that makes the figure again.
    pub query: String,
    /// The step shown.
    pub step: u32,
    /// The step asked for. Of a figure whose drives end at different steps, one beyond the end is the end, also where that moves.
    pub target: u32,
    /// The last step there is.
    pub last: u32,
    /// 0 where what is shown is to be left so: on the way to what was asked for is another moment than that. Else which answer there is to
    /// it ([`crate::model::Model::answer`]). The first picture is watched as it comes, and so is what is mapped of a file.
    pub answer: u32,
    /// What keeps a file from being mapped.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unfit: Option<FigureError>,
}

/// What is shown. What is left out is as it was, or is not there.
#[derive(Serialize)]
pub struct Frame<'a> {
    /// What has changed since the frame before.
    pub news: News<'a>,
    /// Whether it is still on its way to what was asked for.
    pub busy: bool,
    /// What is to be watched until the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub watch: Option<Watch>,
    /// [`crate::model::Model::pace`].
    pub pace: f64,
    /// [`crate::figure::Figure::describe`].
    pub sentence: String,
    /// [`crate::figure::Figure::told`].
    pub told: String,
    /// [`crate::figure::Figure::difference`].
    pub difference: String,
    /// What controls show instead of the values, where a prediction was run.
    pub instead: Entries<String>,
    /// The readout that matters first, by its name.
    pub main: &'static str,
    /// Whether a parameter was changed since that was told last.
    pub changed: bool,
    /// The lines of its algorithm, where these were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<Vec<TraceLine>>,
    /// Where one is asked for.
    pub prediction: Option<Outcome>,
    /// How large the picture is on the page.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<Layout>,
    /// The part of the picture that tells most where there is no room for the whole \[css px\].
    pub gist: Rect,
}

/// What most frames change nothing of: only what is not as it was in the frame before.
#[derive(Serialize)]
pub struct News<'a> {
    /// All parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specs: Option<&'a [ParamSpec]>,
    /// The numbers of what is shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub readouts: Option<&'a [Readout]>,
    /// States that are worth trying, and how it stands with them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chips: Option<&'a [Chip]>,
    /// What can be moved in the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handles: Option<&'a [PlacedHandle]>,
    /// Where controls stand in the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rooms: Option<&'a [Room]>,
}

/// What was told in the frame before.
#[derive(Default)]
pub(crate) struct Told {
    pub specs: Vec<ParamSpec>,
    pub readouts: Vec<Readout>,
    pub chips: Vec<Chip>,
    pub handles: Vec<PlacedHandle>,
    pub rooms: Vec<Room>,
}

/// What is told of it now.
pub(crate) fn news<T: PartialEq>(told: &mut Vec<T>, now: Vec<T>) -> Option<&[T]> {
    if *told == now {
        return None;
    }
    *told = now;
    Some(told)
}

/// What asks to be watched.
#[derive(Serialize)]
pub struct Watch {
    /// The step before it.
    pub from: u32,
    /// What asks for it.
    pub words: &'static str,
}

/// How large a picture is on the page.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Layout {
    /// Px of the page for one of the scene.
    pub scale: f64,
    /// \[css px\]; `None` for all there is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// \[css px\]
    pub height: f64,
    /// What the height would be if nothing had to fit \[css px\].
    pub natural: f64,
}

/// A [`Handle`](crate::scene::Handle) where it lies on the page.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct PlacedHandle {
    /// [`Handle::name`](crate::scene::Handle::name).
    pub name: &'static str,
    /// [`Handle::title`](crate::scene::Handle::title).
    pub title: String,
    /// From the figure's left edge \[css px\].
    pub x: f64,
    /// From the figure's upper edge \[css px\].
    pub y: f64,
    /// [`Handle::axes`](crate::scene::Handle::axes).
    pub axes: &'static [&'static str],
    /// [`Handle::value`](crate::scene::Handle::value).
    pub value: f64,
    /// [`Handle::text`](crate::scene::Handle::text).
    pub text: String,
    /// [`Handle::hover`](crate::scene::Handle::hover).
    pub hover: Option<Rect>,
}
