//! What a figure is written with: `use fastslam_figures_kit::prelude::*`.

pub use crate::{
    decimal::fixed,
    field,
    figure::Figure,
    model::{Declared, FigureError, Model, Readout, Series},
    paint::Theme,
    panels::Panels,
    recipe,
    recipe::{Menu, Param, Recipe},
    scene::{Anchor, Chart, Handle, Letters, Plane, Point, Rect, Role, Sample, Scene, Stack, legend, plain, strong},
    sketch::Sketch,
    view::{Layout, View},
};
