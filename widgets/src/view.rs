//! What a figure looks like and how it is touched: the other half of it, which knows its [`Model`], as the model does not know of it.

use crate::{
    model::{Declared, FigureError, Model},
    panels::Panels,
    scene::{Point, Rect, Scene},
};

/// The picture of a model: its layout, what is drawn, what can be clicked and what can be dragged. One without handles leaves them out.
///
/// All lengths are css px of the scene, which is never narrower than [`View::NARROWEST`].
pub trait View: Default + 'static {
    /// What it shows.
    type Model: Declared + Model + Default + 'static;

    /// Where its parts stand; a [`Rect`], if it is one piece.
    type Layout: Layout;

    /// Narrowest width that is laid out; below, the figure is made smaller as a whole.
    const NARROWEST: f64 = 300.0;

    /// Names of the parts that can be shown by themselves; none for a picture that is one piece.
    const PANELS: &'static [&'static str] = &[];

    /// What is shown of the parts that were asked for: where a parameter folds some in or out, it is this. Nothing else of the state
    /// changes a layout.
    fn parts(_model: &Self::Model, asked: &Panels) -> Panels {
        asked.clone()
    }

    /// Where the parts stand in a scene of this width; those that are not shown have no height. Does not depend on the state, so that
    /// nothing below a figure ever jumps.
    fn layout(width: f64, panels: &Panels) -> Self::Layout;

    /// The part of it that tells most where there is no room for the whole: without names and legends.
    fn gist(_model: &Self::Model, layout: &Self::Layout, width: f64) -> Rect {
        Rect::new(0.0, 0.0, width, layout.height())
    }

    /// Draws into a scene that has its size and its description, and nothing else yet.
    fn draw(&self, model: &Self::Model, layout: &Self::Layout, scene: &mut Scene);

    /// Chooses a thing drawn ([`crate::scene::Region::target`]), or lets go of it if it was chosen.
    fn pick(&self, _model: &mut Self::Model, _target: u32) {}

    /// Moves a handle ([`crate::scene::Handle::name`]) to a point of the layout, or as near to it as the ranges of its parameters
    /// allow. Only parameters move: a page takes no notice of a drag after which the link is the same.
    fn drag(&self, _model: &mut Self::Model, _layout: &Self::Layout, _handle: &str, _to: Point) {}

    /// Moves a handle right and up by steps of its parameters: 1 for an arrow key, 10 for a coarse one, 0.1 for a fine one.
    fn nudge(&self, _model: &mut Self::Model, _handle: &str, _steps: [f64; 2]) {}

    /// Puts a tool into the reader's hand, one of those that the figure's own controls on the page have; an empty name puts it away.
    /// What is in the hand is no part of the recipe.
    fn take(&self, _model: &mut Self::Model, _tool: &str) {}

    /// Uses the tool by a key, or a button that stands for it: right and up.
    ///
    /// # Errors
    /// Where there is no more room for what it does; nothing has changed.
    fn press(&self, _model: &mut Self::Model, _key: &str, _steps: [f64; 2]) -> Result<(), FigureError> {
        Ok(())
    }

    /// Uses the tool along a line that was drawn in the layout, or at its only point.
    ///
    /// # Errors
    /// Where there is no more room for what it does; what there was room for is done.
    fn stroke(&self, _model: &mut Self::Model, _layout: &Self::Layout, _line: &[Point]) -> Result<(), FigureError> {
        Ok(())
    }

    /// How its picture is magnified and moved, if it can be.
    fn navigation(&mut self) -> Option<&mut dyn Navigation<Self>> {
        None
    }

    /// Width of the scene of a figure of this width.
    fn scene_width(width: f64) -> f64 {
        width.max(Self::NARROWEST)
    }

    /// Height that a figure of this width wants with these panels: narrower than the layout goes, it is made smaller as a whole.
    fn height(width: f64, panels: &Panels) -> f64 {
        let scene_width = Self::scene_width(width);
        Self::layout(scene_width, panels).height() * (width / scene_width)
    }

    /// What is to be seen of these panels at this size, or where that is less than the layout takes, at that.
    fn scene(&self, model: &Self::Model, panels: &Panels, width: f64, height: f64) -> Scene {
        let width = Self::scene_width(width);
        let layout = Self::layout(width, panels);
        let mut scene = Scene::new(width, height.max(layout.height()), model.describe());
        self.draw(model, &layout, &mut scene);
        scene
    }
}

/// Where the parts of a picture stand.
pub trait Layout {
    /// How high they are together \[css px\].
    fn height(&self) -> f64;
}

impl Layout for Rect {
    fn height(&self) -> f64 {
        self.bottom()
    }
}

/// By how much a handle moves that has places for whole steps only: there is nothing between two, so that a fine step is a whole one too.
pub fn whole_step(steps: f64) -> f64 {
    if steps == 0.0 { 0.0 } else { steps.signum() * steps.abs().max(1.0) }
}

/// Looking nearer and elsewhere. What is looked at is no part of the recipe.
pub trait Navigation<V: View> {
    /// Magnifies the picture about a point of the layout, or about its middle.
    fn zoom(&mut self, model: &V::Model, layout: &V::Layout, factor: f64, at: Option<Point>);

    /// Moves the picture right and down.
    fn pan(&mut self, model: &V::Model, layout: &V::Layout, by: Point);

    /// Shows the whole again.
    fn fit(&mut self);
}

/// A model and its view, whichever they are: what [`crate::figure::Figure`] holds.
pub(crate) trait Shown {
    fn model(&self) -> &dyn Model;
    fn model_mut(&mut self) -> &mut dyn Model;
    fn panels(&self) -> &'static [&'static str];
    fn show(&mut self, names: &str) -> Result<(), FigureError>;
    fn scene_width(&self, width: f64) -> f64;
    fn height(&self, width: f64) -> f64;
    fn gist(&self, width: f64) -> Rect;
    fn scene(&self, width: f64, height: f64) -> Scene;
    fn pick(&mut self, target: u32);
    fn drag(&mut self, handle: &str, to: Point, width: f64);
    fn nudge(&mut self, handle: &str, steps: [f64; 2]);
    fn take(&mut self, tool: &str);
    fn press(&mut self, key: &str, steps: [f64; 2]) -> Result<(), FigureError>;
    fn stroke(&mut self, line: &[Point], width: f64) -> Result<(), FigureError>;
    fn zoom(&mut self, factor: f64, at: Option<Point>, width: f64);
    fn pan(&mut self, by: Point, width: f64);
    fn fit(&mut self);
}

/// A view with the model that it shows, and the panels that are shown of it.
pub(crate) struct Shows<V: View> {
    pub model: V::Model,
    pub view: V,
    panels: Panels,
}

impl<V: View> Default for Shows<V> {
    fn default() -> Self {
        Self { model: V::Model::default(), view: V::default(), panels: Panels::default() }
    }
}

impl<V: View> Shows<V> {
    fn parts(&self) -> Panels {
        V::parts(&self.model, &self.panels)
    }
}

impl<V: View> Shown for Shows<V> {
    fn model(&self) -> &dyn Model {
        &self.model
    }

    fn model_mut(&mut self) -> &mut dyn Model {
        &mut self.model
    }

    fn panels(&self) -> &'static [&'static str] {
        V::PANELS
    }

    fn show(&mut self, names: &str) -> Result<(), FigureError> {
        self.panels = Panels::named(names, V::PANELS)?;
        Ok(())
    }

    fn scene_width(&self, width: f64) -> f64 {
        V::scene_width(width)
    }

    fn height(&self, width: f64) -> f64 {
        V::height(width, &self.parts())
    }

    fn gist(&self, width: f64) -> Rect {
        let scene_width = V::scene_width(width);
        let layout = V::layout(scene_width, &self.parts());
        V::gist(&self.model, &layout, scene_width).scaled(width / scene_width)
    }

    fn scene(&self, width: f64, height: f64) -> Scene {
        self.view.scene(&self.model, &self.parts(), width, height)
    }

    fn pick(&mut self, target: u32) {
        self.view.pick(&mut self.model, target);
    }

    fn drag(&mut self, handle: &str, to: Point, width: f64) {
        let layout = V::layout(width, &self.parts());
        self.view.drag(&mut self.model, &layout, handle, to);
    }

    fn nudge(&mut self, handle: &str, steps: [f64; 2]) {
        self.view.nudge(&mut self.model, handle, steps);
    }

    fn take(&mut self, tool: &str) {
        self.view.take(&mut self.model, tool);
    }

    fn press(&mut self, key: &str, steps: [f64; 2]) -> Result<(), FigureError> {
        self.view.press(&mut self.model, key, steps)
    }

    fn stroke(&mut self, line: &[Point], width: f64) -> Result<(), FigureError> {
        let layout = V::layout(width, &self.parts());
        self.view.stroke(&mut self.model, &layout, line)
    }

    fn zoom(&mut self, factor: f64, at: Option<Point>, width: f64) {
        let layout = V::layout(width, &self.parts());
        if let Some(navigation) = self.view.navigation() {
            navigation.zoom(&self.model, &layout, factor, at);
        }
    }

    fn pan(&mut self, by: Point, width: f64) {
        let layout = V::layout(width, &self.parts());
        if let Some(navigation) = self.view.navigation() {
            navigation.pan(&self.model, &layout, by);
        }
    }

    fn fit(&mut self) {
        if let Some(navigation) = self.view.navigation() {
            navigation.fit();
        }
    }
}
