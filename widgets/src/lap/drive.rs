//! A reader at the wheel: drives the robot, puts up walls and takes them away, and lifts the robot elsewhere.
//!
//! What is done becomes part of the recipe, and so of a link. What is in the hand does not: a tool, and for the keyboard a cursor.

use super::{
    hand::{Hand, Tool},
    model::LapModel,
    recipe::allowed,
};
use crate::{
    decimal::{between, fixed},
    model::{Declared, FigureError, Model},
    robot::Robots,
    scene::{Plane, Role, Room, Scene},
    words::lap,
};
use fastslam::geometry::Pose2;
use fastslam::ops;
use fastslam_lab::world::{
    EditError, Edits, FORWARD, FloorPlan, GRID, GridWall, MOST_LIFTS, MOST_STEPS, MOST_WALLS, Motion, Place, Turn,
};

/// How near a wall has to be touched to be taken away \[m\].
const REACH: f64 = 0.4;

/// A universe this far from the robot has lost it \[m\].
const LOST: f64 = 1.0;

/// A line drawn shorter than this is a point \[m\].
const POINT: f64 = 0.15;

impl LapModel {
    /// Takes a tool; an unknown name puts away what is in the hand.
    pub fn take(&mut self, name: &str) {
        let robot = self.robot();
        let cursor = self.hand.as_ref().map_or([robot.x, robot.y].map(on_grid), |hand| hand.cursor);
        self.hand = name.parse().ok().map(|tool| Hand { tool, cursor, keyed: false, begun: None });
    }

    /// A key, or a button in its place: `move` uses the tool, or moves the cursor of one that needs a place, `set` uses it there,
    /// `drive` drives whatever is in the hand, and `clear` takes back all that was built and driven.
    pub fn press(&mut self, key: &str, [right, up]: [f64; 2]) -> Result<(), FigureError> {
        if key == "clear" {
            return self.edit("plan", |edits, _| {
                *edits = Edits::default();
                Ok(())
            });
        }
        let size = self.lap().world().plan.size;
        let Some(hand) = &mut self.hand else { return Ok(()) };
        let (tool, cursor) = (hand.tool, hand.cursor);
        match (key, tool) {
            ("drive", _) | ("move", Tool::Wheel) if up > 0.0 => self.drive(&[Motion::straight()]),
            ("drive", _) | ("move", Tool::Wheel) if up < 0.0 => self.drive(&[Motion::Back]),
            ("drive", _) | ("move", Tool::Wheel) => self.drive(&[Motion::Turn(Turn::by(-right as i32))]),
            ("move", _) => {
                let to = [cursor[0] + GRID * right, cursor[1] + GRID * up];
                let to = core::array::from_fn(|k| on_grid(between(to[k], 0.0, size[k])));
                (hand.cursor, hand.keyed) = (to, true);
                Ok(())
            }
            ("set", _) => self.touch(tool, cursor),
            _ => {
                hand.begun = None;
                Ok(())
            }
        }
    }

    /// A line that was drawn \[m\].
    pub fn stroke(&mut self, line: &[[f64; 2]]) -> Result<(), FigureError> {
        let (Some(hand), [from, .., to] | [from @ to]) = (&mut self.hand, line) else { return Ok(()) };
        let (tool, drawn) = (hand.tool, apart(*from, *to) > POINT);
        (hand.cursor, hand.keyed) = (to.map(on_grid), false);
        match tool {
            Tool::Wheel => self.follow(line),
            Tool::Wall if drawn => {
                hand.begun = None;
                self.put_up(*from, *to)
            }
            _ => self.touch(tool, *to),
        }
    }

    /// Uses a tool at a point \[m\].
    fn touch(&mut self, tool: Tool, at: [f64; 2]) -> Result<(), FigureError> {
        let course = self.recipe.setup.course.route().plan;
        match tool {
            Tool::Wheel => self.follow(&[at]),
            Tool::Wall => match self.hand.as_mut().and_then(|hand| hand.begun.take()) {
                Some(from) => self.put_up(from, at),
                None => {
                    self.hand.iter_mut().for_each(|hand| hand.begun = Some(inside(&course, at)));
                    Ok(())
                }
            },
            Tool::Erase => match self.recipe.setup.edits.walls.nearest(&course, at) {
                Some((wall, near)) if near < REACH => self.edit("plan", |edits, _| edits.walls.erase(wall)),
                _ => Ok(()),
            },
            Tool::Lift => {
                // Set down as near to the outer walls as it could stand.
                let [x, y] = core::array::from_fn(|k| between(at[k], 0.2, course.size[k] - 0.2));
                self.drive(&[Motion::Lift(Place::near(&Pose2 { x, y, ..self.robot() }))])
            }
        }
    }

    fn put_up(&mut self, from: [f64; 2], to: [f64; 2]) -> Result<(), FigureError> {
        let plan = self.recipe.setup.course.route().plan;
        let [from, to] = [from, to].map(|end| inside(&plan, end));
        match GridWall::near(from, to) {
            Some(wall) => self.edit("plan", |edits, _| edits.walls.add(wall)),
            None => Ok(()),
        }
    }

    /// Drives along a line from where the robot is, until a wall stops it.
    fn follow(&mut self, line: &[[f64; 2]]) -> Result<(), FigureError> {
        let (plan, mut robot) = (&self.lap().world().plan, self.robot());
        let (mut motions, mut line) = (Vec::new(), line.iter().peekable());
        while let Some(&&to) = line.peek() {
            if apart([robot.x, robot.y], to) < FORWARD {
                line.next();
                continue;
            }
            let motion = Motion::Go(Turn::near(ops::atan2(to[1] - robot.y, to[0] - robot.x) - robot.theta));
            let next = motion.from(&robot);
            motions.push(motion);
            if motions.len() > MOST_STEPS || !plan.is_open([robot.x, robot.y], [next.x, next.y]) {
                break;
            }
            robot = next;
        }
        // It stays at the step shown, so that the reader sees it drive.
        let step = self.recipe.step;
        let driven = self.drive(&motions);
        self.seek(step);
        driven
    }

    /// Drives on from the step asked for, and asks for the last step of that.
    fn drive(&mut self, motions: &[Motion]) -> Result<(), FigureError> {
        let (mut step, course) = (self.recipe.step as usize, self.recipe.setup.course.steps());
        let mut full = Ok(());
        self.edit("drive", |edits, asked| {
            for motion in motions {
                full = edits.steering.drive_on(step, course, *motion);
                if full.is_err() {
                    break;
                }
                step += 1;
            }
            *asked = step as u32;
            Ok(())
        })?;
        full.map_err(|error| left_out("drive", error))
    }

    fn edit(
        &mut self,
        field: &str,
        change: impl FnOnce(&mut Edits, &mut u32) -> Result<(), EditError>,
    ) -> Result<(), FigureError> {
        let mut recipe = self.recipe.clone();
        change(&mut recipe.setup.edits, &mut recipe.step).map_err(|error| left_out(field, error))?;
        self.adopt(recipe)
    }

    /// Where the robot truly is at the step asked for.
    fn robot(&self) -> Pose2 {
        let truth = &self.lap().world().truth;
        truth[(self.recipe.step as usize).min(truth.len() - 1)]
    }

    /// What a reader's drive has brought about at the step shown: where it has to be said.
    pub fn news(&self) -> Option<String> {
        let (step, world) = (self.step(), self.lap().world());
        let lifted = world.lifted.iter().rev().find(|lifted| **lifted <= step).map(|&lifted| {
            let [from, to] = [lifted - 1, lifted].map(|step| world.truth[step as usize]);
            let nearest = self.lap().nearest_universe();
            let (far, near) = (&fixed(from.distance(&to), 1), &fixed(nearest, 1));
            match nearest > LOST {
                true => lap::LiftedLost { step: &lifted, far, near }.say(),
                false => lap::LiftedFound { step: &lifted, far, near }.say(),
            }
        });
        let stopped = world.stopped.contains(&step).then(|| lap::stopped().into());
        let news: Vec<String> = stopped.into_iter().chain(lifted).collect();
        (!news.is_empty()).then(|| news.join(" "))
    }

    /// The step shown, for somebody at the wheel.
    pub fn told_at_the_wheel(&self, hand: &Hand) -> String {
        let place = |[x, y]: [f64; 2]| format!("({}, {})", fixed(x, 1), fixed(y, 1));
        let held = match (hand.tool, hand.begun) {
            (Tool::Wheel, _) => None,
            (_, Some(from)) => Some(lap::WallBegun { from: &place(from), to: &place(hand.cursor) }.say()),
            _ if !hand.keyed => None,
            _ => Some(lap::CursorAt { place: &place(hand.cursor) }.say()),
        };
        let near = &fixed(self.lap().nearest_universe(), 2);
        let step = lap::AtTheWheel { step: &self.step(), last: &self.step_count(), near }.say();
        let lifted = self.lap().world().lifted.first().is_some_and(|lifted| *lifted <= self.step());
        // How far the universes are is said with a lifting.
        let step = (!lifted).then_some(step);
        held.into_iter().chain(self.news()).chain(step).collect::<Vec<_>>().join(" ")
    }
}

/// What could not be added to a field, and why.
fn left_out(field: &str, error: EditError) -> FigureError {
    let message = match error {
        EditError::Many => lap::Full { walls: &MOST_WALLS, steps: &MOST_STEPS, lifts: &MOST_LIFTS }.say(),
        error => allowed(error),
    };
    FigureError { parameter: field.into(), message }
}

/// What the reader has in the hand and has put up, and how far the nearest universe is from a robot that was lifted.
pub fn draw(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    scene.rooms.push(Room { parameter: "drive", area: plane.area });
    let Some(hand) = &model.hand else { return };
    let walls = model.recipe.setup.edits.walls.added().iter().map(GridWall::segment);
    scene.rimmed(walls.map(|wall| vec![plane.point(wall.a), plane.point(wall.b)]).collect(), 2.5, None, Role::Accent);
    let robot = model.lap().world().truth[model.step() as usize];
    scene.rimmed_robot(plane, &robot, 10.0, Role::Truth);
    if hand.tool != Tool::Wheel {
        let [x, y] = plane.point(hand.cursor);
        let cross = vec![vec![[x - 7.0, y], [x + 7.0, y]], vec![[x, y - 7.0], [x, y + 7.0]]];
        let begun = hand.begun.map(|from| vec![plane.point(from), [x, y]]);
        scene.rimmed(cross.into_iter().chain(begun).collect(), 2.0, None, Role::Accent);
    }
}

fn on_grid(x: f64) -> f64 {
    (x / GRID).round() / 10.0
}

fn inside(plan: &FloorPlan, point: [f64; 2]) -> [f64; 2] {
    core::array::from_fn(|k| on_grid(between(point[k], 0.0, plan.size[k])))
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    ops::hypot(a[0] - b[0], a[1] - b[1])
}
