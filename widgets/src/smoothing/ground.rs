//! The drive as it is seen: the ancestry that the filter has left, or the paths that sweeps have drawn.

use super::{
    layout::Layout,
    model::{Account, SmoothingModel},
};
use crate::{
    scene::{NINE_TENTHS, Plane, Point, RIM, Rect, Role, Sample, Scene, clip_polyline, joined, legend, lens},
    words::{common, smoothing as words},
};
use fastslam::{geometry::Pose2, nalgebra::Matrix3};

/// Colours of what the filter has left, of what sweeps have drawn, and of what has died out.
pub const RECORD: Role = Role::Prior;
/// See [`RECORD`].
pub const DRAWN: Role = Role::Posterior;
const DEAD: Role = Role::Level(70);

/// What is seen of the world \[m\].
const REACH: [f64; 2] = [6.6, 11.4];

/// Every so many steps of the first half of the drive a region is drawn.
const EVERY: usize = 5;

/// Radius of a pose at the step that is looked at \[css px\].
const POSE: f64 = 2.2;

/// A place for the drive. The world has no north: where there is more room across, it lies on its side.
struct Ground {
    plane: Plane,
    wide: bool,
}

impl Ground {
    fn of(area: Rect, wide: bool) -> Self {
        let [x, y] = if wide { [REACH[1], REACH[0]] } else { REACH };
        Self { plane: Plane::around(area, [[-x, -y], [x, y]], 2.0), wide }
    }

    fn turned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.wide { [-y, x] } else { [x, y] }
    }

    fn point(&self, place: [f64; 2]) -> Point {
        self.plane.point(self.turned(place))
    }

    /// Lines of the world, cut at the edges.
    fn lines<'a>(&self, lines: impl IntoIterator<Item = &'a Vec<[f64; 2]>>) -> Vec<Vec<Point>> {
        let cut = |line: &Vec<[f64; 2]>| {
            let points: Vec<Point> = line.iter().map(|place| self.point(*place)).collect();
            clip_polyline(&points, &self.plane.area)
        };
        joined(lines.into_iter(), cut)
    }

    fn path(&self, poses: &[Pose2]) -> Vec<Vec<Point>> {
        self.lines(&[poses.iter().map(|pose| [pose.x, pose.y]).collect()])
    }

    /// The region that holds nine tenths of a Gaussian.
    fn region(&self, (mean, covariance): &(Pose2, Matrix3<f64>)) -> Vec<Vec<Point>> {
        let (xx, xy, yy) = (covariance.m11, covariance.m12, covariance.m22);
        let covariance = if self.wide { [[yy, -xy], [-xy, xx]] } else { [[xx, xy], [xy, yy]] };
        self.plane.region(self.turned([mean.x, mean.y]), covariance, NINE_TENTHS)
    }
}

/// Draws both, with their names.
pub fn maps(scene: &mut Scene, model: &SmoothingModel, layout: &Layout) {
    let m = model.particles();
    let sweeps = model.sweeps();
    let names = [words::Record { m: &m }.say(), words::RecordShort { m: &m }.say()];
    scene.heading_fit(&layout.headers[0], (words::before(), Role::Ink), &names);
    let names = match sweeps {
        _ if model.hides() => [words::hidden().into(), words::hidden_short().into()],
        0 => [words::nothing_drawn().into(), words::nothing_drawn_short().into()],
        _ => [words::Drawn { n: &sweeps }.say(), words::DrawnShort { n: &sweeps }.say()],
    };
    scene.heading_fit(&layout.headers[1], (words::after(), Role::Ink), &names);
    for (rank, area) in layout.maps.into_iter().enumerate() {
        let ground = Ground::of(area, layout.wide);
        let landmarks = model.run().log().landmarks.iter().map(|m| ground.point([m.x, m.y]));
        scene.cloud(landmarks, &area.inset(3.0), 2.5, Role::Feature);
        if rank == 0 {
            record(scene, model, &ground)
        } else {
            draws(scene, model, &ground)
        }
        scene.dashed(ground.path(&model.run().log().truth), 1.5, [4.0, 3.0], Role::Truth);
        let account = if rank == 0 { model.before() } else { model.after() };
        if let Some(account) = account {
            regions(scene, model, &ground, &account, rank);
        }
        scene.frame(area, 1.0, Role::Frame);
        scene.scale_bar(&ground.plane, 5.0, 80.0);
        nearby(scene, model, &ground, rank);
    }
}

/// The ancestry: what has died out, and what is left.
fn record(scene: &mut Scene, model: &SmoothingModel, ground: &Ground) {
    let Some(record) = model.run().record() else { return };
    scene.lines(ground.lines(&record.dead), 1.0, DEAD);
    scene.lines(ground.lines(&record.branches), 1.25, RECORD);
    scene.rimmed(ground.lines([&record.trunk]), 2.25, None, RECORD);
}

/// The paths that were drawn.
fn draws(scene: &mut Scene, model: &SmoothingModel, ground: &Ground) {
    let draws = model.run().draws().iter().take(model.sweeps() as usize);
    scene.lines(joined(draws, |draw| ground.path(&draw.path)), 1.0, DRAWN);
}

/// How much is known of early poses, and the poses at the step that is looked at.
fn regions(scene: &mut Scene, model: &SmoothingModel, ground: &Ground, account: &Account, rank: usize) {
    let early = model.run().early();
    let of_early = account.moments.iter().enumerate().filter(|(step, _)| early.contains(step) && step % EVERY == 0);
    scene.lines(joined(of_early, |(_, moments)| ground.region(moments)), 1.25, Role::Ink);
    looked_at(scene, model, ground, rank);
}

/// The poses at the step that is looked at, and where the robot truly was.
fn looked_at(scene: &mut Scene, model: &SmoothingModel, ground: &Ground, rank: usize) {
    let at = model.at() as usize;
    let poses: Vec<Point> = if rank == 0 {
        model.run().ancestors(at).map(|pose| ground.point([pose.x, pose.y])).collect()
    } else {
        let draws = model.run().draws().iter().take(model.sweeps() as usize);
        draws.map(|draw| ground.point([draw.path[at].x, draw.path[at].y])).collect()
    };
    let area = ground.plane.area.inset(POSE + RIM);
    scene.cloud(poses.iter().copied(), &area, POSE + RIM, Role::Paper);
    scene.cloud(poses.into_iter(), &area, POSE, Role::Accent);
    let truth = &model.run().log().truth[at];
    scene.cross(Rect::around(ground.point([truth.x, truth.y]), 4.0), 1.5, Role::Truth);
}

/// What is too small to be told apart at the step that is looked at, at the same place in both maps.
fn nearby(scene: &mut Scene, model: &SmoothingModel, ground: &Ground, rank: usize) {
    let Some(account) = (if rank == 0 { model.before() } else { model.after() }) else { return };
    let (at, Some(before)) = (model.at() as usize, model.before()) else { return };
    // Between the truth and what the filter has left, so that both are seen.
    let (truth, left) = (&model.run().log().truth[at], &before.moments[at].0);
    let place = [0.5 * (truth.x + left.x), 0.5 * (truth.y + left.y)];
    lens(scene, &ground.plane, ground.turned(place), &mut |scene, plane| {
        let near = Ground { plane, wide: ground.wide };
        if rank == 0 {
            record(scene, model, &near);
        } else {
            draws(scene, model, &near);
        }
        scene.lines(near.region(&account.moments[at]), 1.25, Role::Ink);
        looked_at(scene, model, &near, rank);
    });
}

/// What lines and dots are.
pub fn key(scene: &mut Scene, model: &SmoothingModel, layout: &Layout, pinned: bool) {
    let mut items = vec![
        (Sample::line(RECORD, 2.25, None), words::key_record().to_string()),
        (Sample::line(DEAD, 1.0, None), words::key_dead().into()),
        (Sample::line(DRAWN, 2.0, None), words::key_drawn().into()),
        (Sample::line(Role::Truth, 1.5, Some([4.0, 3.0])), common::truth().into()),
        (Sample::dot(Role::Accent, POSE).wide(8.0), words::KeyAt { at: &model.at() }.say()),
    ];
    if pinned {
        items.push((Sample::pinned(), common::pinned_mark().into()));
    }
    legend(scene, &layout.legend, items);
}
