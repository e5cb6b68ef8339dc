//! What a figure is written with: `use fastslam_widgets::prelude::*`.

pub use crate::{
    decimal::fixed,
    field,
    figure::Figure,
    model::{Declared, FigureError, Model, Readout, Series, Stateless},
    panels::Panels,
    recipe::{Menu, Param, Recipe},
    scene::{
        Anchor, Chart, Handle, Mark, Plane, Point, Rect, Role, Sample, Scene, Stack, cloud, heading, legend, text,
    },
    view::{Layout, View},
};
