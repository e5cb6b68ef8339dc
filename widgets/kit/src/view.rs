//! What a figure looks like and how it is touched: the other half of it, which knows its [`Model`], as the model does not know of it.

use crate::{
    action::Own,
    model::{Declared, FigureError, Model, Tells},
    panels::Panels,
    scene::{Point, Rect, Scene},
};

/// The picture of a model: its layout, what is drawn, what can be clicked and what can be dragged. One without handles leaves them out.
///
/// All lengths are css px of the scene, which is never narrower than [`Layout::NARROWEST`].
pub trait View: Default + 'static {
    /// What it shows.
    type Model: Declared + Model + Default + 'static;

    /// Where its parts stand.
    type Layout: Layout;

    /// What is shown of the parts that were asked for: where a parameter folds some in or out, it is this. Nothing else of the state
    /// changes a layout.
    fn parts(_model: &Self::Model, asked: &Panels) -> Panels {
        asked.clone()
    }

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

    /// Does what only this kind of figure can do, in a scene of a width with these panels. Lengths in it are css px of the page, each of
    /// which is `scale` of the scene's.
    ///
    /// # Errors
    /// Where there is no room for all of it; what there was room for is done.
    fn own(
        &mut self,
        _model: &mut Self::Model,
        _own: &Own,
        (_width, _scale): (f64, f64),
        _panels: &Panels,
    ) -> Result<(), FigureError> {
        Ok(())
    }

    /// Width of the scene of a figure of this width.
    fn scene_width(width: f64) -> f64 {
        width.max(Self::Layout::NARROWEST)
    }

    /// Height that a figure of this width wants with these panels: narrower than the layout goes, it is made smaller as a whole.
    fn height(width: f64, panels: &Panels) -> f64 {
        let scene_width = Self::scene_width(width);
        Self::Layout::of(scene_width, panels).height() * (width / scene_width)
    }

    /// What is to be seen of these panels at this size, or where that is less than the layout takes, at that.
    fn scene(&self, model: &Self::Model, panels: &Panels, width: f64, height: f64) -> Scene {
        let width = Self::scene_width(width);
        let layout = Self::Layout::of(width, panels);
        let mut scene = Scene::new(width, height.max(layout.height()), model.describe());
        self.draw(model, &layout, &mut scene);
        scene
    }
}

/// Where the parts of a picture stand, and which of them are panels. Does not depend on the state, so that nothing below a figure ever jumps.
pub trait Layout: Sized {
    /// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
    const NARROWEST: f64 = 300.0;

    /// Names of the parts that can be shown by themselves; none for a picture that is one piece.
    const PANELS: &'static [&'static str] = &[];

    /// Where the parts of these panels stand in a scene of this width, which is no less than the narrowest; those of others have no height.
    fn laid_out(width: f64, panels: &Panels) -> Self;

    /// How high they are together \[css px\].
    fn height(&self) -> f64;

    /// That of these panels, for a scene of any width.
    fn of(width: f64, panels: &Panels) -> Self {
        Self::laid_out(if width.is_finite() { width.max(Self::NARROWEST) } else { Self::NARROWEST }, panels)
    }

    /// That of all panels, for a scene of any width.
    fn new(width: f64) -> Self {
        Self::of(width, &Panels::default())
    }
}

/// By how much a handle moves that has places for whole steps only: there is nothing between two, so that a fine step is a whole one too.
pub fn whole_step(steps: f64) -> f64 {
    if steps == 0.0 { 0.0 } else { steps.signum() * steps.abs().max(1.0) }
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
    fn own(&mut self, own: &Own, width: f64, scale: f64) -> Result<(), FigureError>;
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
        V::Layout::PANELS
    }

    fn show(&mut self, names: &str) -> Result<(), FigureError> {
        self.panels = Panels::named(names, V::Layout::PANELS)?;
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
        let layout = V::Layout::of(scene_width, &self.parts());
        V::gist(&self.model, &layout, scene_width).scaled(width / scene_width)
    }

    fn scene(&self, width: f64, height: f64) -> Scene {
        self.view.scene(&self.model, &self.parts(), width, height)
    }

    fn pick(&mut self, target: u32) {
        self.view.pick(&mut self.model, target);
    }

    fn drag(&mut self, handle: &str, to: Point, width: f64) {
        let layout = V::Layout::of(width, &self.parts());
        self.view.drag(&mut self.model, &layout, handle, to);
    }

    fn nudge(&mut self, handle: &str, steps: [f64; 2]) {
        self.view.nudge(&mut self.model, handle, steps);
    }

    fn own(&mut self, own: &Own, width: f64, scale: f64) -> Result<(), FigureError> {
        self.view.own(&mut self.model, own, (width, scale), &self.panels)
    }
}
