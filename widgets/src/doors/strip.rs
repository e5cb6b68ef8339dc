//! The corridor with its doors, the particles piled up above it, and the Gaussian of EKF-SLAM hanging below.

use super::{layout::Layout, model::DoorsModel, told};
use crate::{
    decimal::{between, write},
    model::Model,
    order::ascending,
    robot::robot,
    scene::{Letters, Point, Rect, Role, Scene, diamond, plain, strong},
    words::doors as words,
};
use fastslam::ops;
use fastslam_lab::experiment::doors::{Belief, REACH, RIDE_END, SIGN};

/// What is seen of the corridor \[m\].
const FROM: f64 = -2.0;
const TO: f64 = 25.0;

/// Width of a door \[m\].
const DOOR: f64 = 1.0;

/// Diameter of a particle at the most, and at the least \[css px\].
const LARGEST: f64 = 5.5;
const SMALLEST: f64 = 1.6;

/// What the filters are told.
const TOLD: Letters = plain(11.0, Role::Muted).end();

/// Corners of a bell.
const CORNERS: u32 = 48;

/// How many deviations of it are drawn.
const DEVIATIONS: f64 = 3.5;

/// Who is EKF-SLAM.
pub const EKF: Role = Role::Raw;

/// The corridor as it is drawn.
pub struct Strip<'a> {
    pub model: &'a DoorsModel,
    pub layout: &'a Layout,
}

/// The colour of what is taken for a landmark.
fn role(model: &DoorsModel, belief: Belief) -> Role {
    match belief {
        Belief::Nothing | Belief::New => Role::Muted,
        Belief::Landmark(rank) if rank as usize == model.setup().doors.len() => Role::Feature,
        Belief::Landmark(rank) => Role::Class(rank as u8),
    }
}

impl Strip<'_> {
    /// Css px per metre.
    fn scale(&self) -> f64 {
        self.layout.strip.w / (TO - FROM)
    }

    /// Where a place of the corridor \[m\] is \[css px\].
    pub fn x(&self, place: f64) -> f64 {
        self.layout.strip.x + (place - FROM) * self.scale()
    }

    /// What place \[m\] is there.
    pub fn place(&self, x: f64) -> f64 {
        FROM + (x - self.layout.strip.x) / self.scale()
    }

    /// The middle of a door.
    pub fn door(&self, rank: usize) -> Point {
        [self.x(self.model.setup().doors[rank]), self.layout.strip.y + 9.0]
    }

    /// Where the ride truly ended, on the lower wall.
    pub fn end(&self) -> Point {
        [self.x(self.model.end()), self.layout.strip.bottom() - 7.0]
    }

    pub fn draw(&self, scene: &mut Scene) {
        self.headers(scene);
        self.through(scene);
        self.piles(scene);
        self.bell(scene);
        self.corridor(scene);
        if self.model.is_carried() {
            self.ride(scene);
        }
        self.robot(scene);
    }

    fn headers(&self, scene: &mut Scene) {
        let (model, now, wide) = (self.model, self.model.now(), self.layout.wide);
        let m = &model.setup().particles;
        let alive = now.explanations(model.setup());
        let particles = words::ParticlesAre { m }.say();
        let rest = match (model.is_carried(), wide) {
            (false, true) => words::all_agree().into(),
            (false, false) => words::all_agree_short().into(),
            (true, _) if alive > 1 => words::Hold { n: &alive }.say(),
            (true, true) => words::HoldOne { right: &told::verdict(now.fastslam_right()) }.say(),
            (true, false) => words::HoldOneShort { right: &told::verdict(now.fastslam_right()) }.say(),
        };
        scene.heading(&self.layout.particles_header, (&particles, Role::Path), &rest);
        let door = &told::belief(model, now.ekf_belief);
        let std = &told::deviation(now.ekf_std);
        let right = &told::verdict(now.ekf_right());
        let rest = match (model.is_carried(), now.ekf_belief, wide) {
            (false, ..) => words::EkfMaps { std }.say(),
            (true, Belief::Nothing, true) => words::EkfTold { std }.say(),
            (true, Belief::Nothing, false) => words::EkfToldShort { std }.say(),
            (true, _, true) => words::EkfSure { door, std, right }.say(),
            (true, _, false) => words::EkfSureShort { std, right }.say(),
        };
        scene.heading(&self.layout.ekf_header, ("EKF-SLAM", EKF), &rest);
    }

    /// A line through everything where the robot is.
    fn through(&self, scene: &mut Scene) {
        let (x, top) = (self.x(self.model.now().truth), self.layout.particles.y);
        scene.dash(&[[x, top], [x, self.layout.ekf.bottom()]], 1.0, [2.0, 3.0], Role::Truth);
    }

    /// Each particle where it is, and as near to it as there is room, on the others.
    fn piles(&self, scene: &mut Scene) {
        let (model, now, area) = (self.model, self.model.now(), self.layout.particles);
        let m = now.places.len() as f64;
        // All of them have room in one pile that does not reach the next.
        let room = 0.7 * model.setup().spacing().min(3.0) * self.scale() * (area.h - 4.0);
        let pitch = (room / m).sqrt().clamp(SMALLEST, LARGEST);
        let (columns, rows) = ((area.w / pitch) as usize, ((area.h - 4.0) / pitch) as usize);
        let mut filled = vec![0_usize; columns.max(1)];
        let mut kinds: Vec<(Role, Vec<Point>)> = Vec::new();
        for slot in ascending(&now.places) {
            let wanted = (self.x(now.places[slot]) - area.x) / pitch;
            if !(0.0..columns as f64).contains(&wanted) {
                continue;
            }
            let Some(column) = nearest_with_room(&filled, wanted as usize, rows) else { continue };
            let at = [area.x + (column as f64 + 0.5) * pitch, area.bottom() - (filled[column] as f64 + 0.5) * pitch];
            filled[column] += 1;
            // Of next to no weight: on its way out.
            let light = now.weights[slot] * m < 0.1;
            let role = if light { Role::Frame } else { role(model, now.beliefs[slot]) };
            match kinds.iter_mut().find(|(kind, _)| *kind == role) {
                Some((_, centres)) => centres.push(at),
                None => kinds.push((role, vec![at])),
            }
        }
        let radius = 0.46 * pitch;
        for (role, centres) in kinds {
            scene.discs(centres, radius, role);
        }
    }

    /// The density of EKF-SLAM, as high at its mean whatever its width; from there a line to the landmark that it is tied to.
    fn bell(&self, scene: &mut Scene) {
        let (now, Rect { y, h, .. }) = (self.model.now(), self.layout.ekf);
        let edges = [self.layout.strip.x, self.layout.strip.right()];
        // Never thinner than can be seen.
        let std = (now.ekf_std * self.scale()).max(1.3);
        let mean = self.x(now.ekf_place);
        let corner = |k: u32| {
            let deviations = DEVIATIONS * (2.0 * f64::from(k) / f64::from(CORNERS) - 1.0);
            let x = between(mean + deviations * std, edges[0], edges[1]);
            [x, y + 0.86 * h * ops::exp(-0.5 * deviations * deviations)]
        };
        let mut corners = vec![[between(mean - DEVIATIONS * std, edges[0], edges[1]), y]];
        corners.extend((0..=CORNERS).map(corner));
        corners.push([between(mean + DEVIATIONS * std, edges[0], edges[1]), y]);
        scene.polygon(corners, EKF);
        if let Some(place) = self.tied_to() {
            scene.line(&[[mean, y], [self.x(place), self.layout.strip.y + 18.0]], 2.0, EKF);
        }
    }

    /// Where the landmark is \[m\] that EKF-SLAM takes the one in view for.
    fn tied_to(&self) -> Option<f64> {
        let (now, setup) = (self.model.now(), self.model.setup());
        match now.ekf_belief {
            _ if now.seen.is_empty() => None,
            Belief::Landmark(rank) => Some(setup.doors.get(rank as usize).copied().unwrap_or(SIGN)),
            Belief::New | Belief::Nothing => None,
        }
    }

    /// Walls, doors with their numbers, and the sign.
    fn corridor(&self, scene: &mut Scene) {
        let (Rect { x, y, w, h }, setup) = (self.layout.strip, self.model.setup());
        scene.lines([y + 9.0, y + h - 7.0].map(|y| vec![[x, y], [x + w, y]]).into(), 2.0, Role::Muted);
        for (rank, place) in setup.doors.iter().enumerate() {
            let half = 0.5 * DOOR * self.scale();
            let area = Rect::new(self.x(*place) - half, y + 3.0, 2.0 * half, 12.0);
            scene.fill(area, Role::Class(rank as u8));
            let number = Rect::new(area.x, y + 1.0, area.w, 16.0);
            scene.text(number, strong(11.5, Role::Paper).middle(), &(rank + 1).to_string());
        }
        let sign = [self.x(SIGN), y + 9.0];
        scene.rimmed_polygon(diamond(sign, 8.0), Role::Feature);
        if self.layout.wide {
            let left = self.x(SIGN + 1.8);
            scene.text(Rect::new(left, y + 13.0, x + w - left, 16.0), plain(11.5, Role::Muted), words::sign());
        }
    }

    /// What both filters are told of the ride, and where it truly ended.
    fn ride(&self, scene: &mut Scene) {
        let (std, y) = (self.model.setup().ride_std, self.layout.strip.bottom() - 2.0);
        let ends = [RIDE_END - std, RIDE_END + std].map(|place| self.x(place.clamp(FROM, TO)));
        let lines = vec![
            vec![[ends[0], y - 4.0], [ends[0], y], [ends[1], y], [ends[1], y - 4.0]],
            vec![[self.x(RIDE_END), y - 5.0], [self.x(RIDE_END), y]],
        ];
        scene.lines(lines, 1.25, Role::Muted);
        // While the Gaussian is as wide as that, it says so itself.
        if self.model.now().ekf_std < 1.0 {
            let told = words::ToldRide { place: &write(RIDE_END), std: &write(std) }.say();
            let (left, right) = (self.layout.strip.x + 2.0, ends[0] - 6.0);
            if TOLD.width(&told) < right - left {
                scene.text(Rect::new(left, self.layout.ekf.y + 1.0, right - left, 14.0), TOLD, &told);
            }
        }
        let [x, y] = self.end();
        scene.rimmed_polygon(vec![[x, y - 6.0], [x + 6.0, y + 5.0], [x - 6.0, y + 5.0]], Role::Accent);
    }

    /// The robot, as far as it sees, and what it sees.
    fn robot(&self, scene: &mut Scene) {
        let (now, Rect { y, .. }) = (self.model.now(), self.layout.strip);
        let at = [self.x(now.truth), y + 33.0];
        for rank in &now.seen {
            let place = self.model.setup().doors.get(*rank as usize).copied().unwrap_or(SIGN);
            scene.line(&[at, [self.x(place), y + 16.0]], 1.25, Role::Truth);
        }
        scene.dash(&[-REACH, REACH].map(|reach| [self.x(now.truth + reach), y + 20.0]), 1.0, [2.0, 2.0], Role::Truth);
        let back = self.model.step() == self.model.ride();
        scene.rimmed_polygon(robot(at, if back { core::f64::consts::PI } else { 0.0 }, 10.0), Role::Truth);
    }
}

/// The column nearest to this one that is not full.
fn nearest_with_room(filled: &[usize], wanted: usize, rows: usize) -> Option<usize> {
    // Lower columns first among those near: that makes a heap rather than a tower.
    let cost = |column: usize| 2 * column.abs_diff(wanted) + filled[column] / 2;
    (0..filled.len()).filter(|column| filled[*column] < rows).min_by_key(|column| cost(*column))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pile_grows_to_both_sides_before_it_is_a_tower() {
        let mut filled = vec![0; 41];
        for _ in 0..60 {
            let column = nearest_with_room(&filled, 20, 30).unwrap();
            filled[column] += 1;
        }
        assert!(filled[20] > filled[18] && filled[18] > 0 && filled[22] > 0, "{filled:?}");
        assert!(filled[20] < 30 && filled[10] == 0);
        assert_eq!(nearest_with_room(&[2, 2], 0, 2), None);
    }
}
