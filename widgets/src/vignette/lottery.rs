//! New ground says the same of all: a score that scatters by chance, taken for evidence, picks paths like a lottery.

use super::{Kind, MARGIN, label};
use crate::{
    decimal::fixed,
    robot::Poses,
    scene::{Anchor, LINE, Plane, Rect, Role, Scene},
    words::vignette::{self, LotteryTold},
};
use fastslam::{
    genealogy::{Descent, Path},
    geometry::Pose2,
    motion::{Motion as _, Odometry, OdometryModel},
    ops,
    random::{Purpose, Stream},
    resampling::{ResamplePolicy, Scheme},
    weights::Weights,
};

const PARTICLES: usize = 16;

/// Steps of the drive, straight ahead \[m\], on wheels that lose their heading.
const STEPS: u32 = 40;
const DRIVE: Odometry = Odometry { rot1: 0.0, trans: 0.3, rot2: 0.0 };
const WHEELS: OdometryModel = OdometryModel { alphas: [0.0, 0.0012, 0.0025, 0.0] };

/// How much the score of a scan scatters between particles that know equally much, in new ground \[nats\]: as measured on the ring.
const SCATTER: f64 = 0.8;

const SEED: u64 = 9;

/// Places of the handle from nothing to all.
const PLACES: u32 = 20;

pub const KIND: Kind = Kind {
    name: "lottery",
    handle: vignette::lottery_handle,
    last: PLACES,
    value: |at| (percent(at), "%"),
    number: vignette::lottery_number,
    result: |at| {
        let left = Run::of(at).left();
        (left.into(), left.to_string(), "")
    },
    told: |at| {
        let run = Run::of(at);
        LotteryTold {
            price: &percent(at),
            n: &run.resampled,
            steps: &STEPS,
            left: &run.left(),
            m: &PARTICLES,
            near: &fixed(run.nearest(), 2),
        }
        .say()
    },
    draw,
};

/// The share of what new ground says that goes into the weights.
fn price(at: u32) -> f64 {
    f64::from(at) / f64::from(PLACES)
}

fn percent(at: u32) -> String {
    fixed(100.0 * price(at), 0)
}

/// One more pose, with the noise of a particle of its own.
fn drive_on(path: &mut Path, step: u32, slot: u32) {
    path.push(WHEELS.sample(&path.pose(), &DRIVE, &mut Stream::at(SEED, Purpose::PROPOSAL, step, slot)));
}

/// Where a robot went that no particle is.
fn truth() -> Vec<Pose2> {
    let mut path = Path::start(Pose2::default());
    (0..STEPS).for_each(|step| drive_on(&mut path, step, PARTICLES as u32));
    path.poses()
}

struct Run {
    living: Vec<Path>,
    /// Those that had no descendants.
    dead: Vec<Path>,
    /// How many steps resampled.
    resampled: u32,
}

impl Run {
    fn of(at: u32) -> Self {
        let living = (0..PARTICLES).map(|_| Path::start(Pose2::default())).collect();
        let mut run = Self { living, dead: Vec::new(), resampled: 0 };
        let mut weights = Weights::uniform(PARTICLES);
        for step in 0..STEPS {
            (0..).zip(&mut run.living).for_each(|(slot, path)| drive_on(path, step, slot));
            let says = |slot| price(at) * SCATTER * Stream::at(SEED, Purpose::TRIAL, step, slot).normal();
            (weights, _) = weights.reweighted(&(0..PARTICLES as u32).map(says).collect::<Vec<_>>());
            if ResamplePolicy::EssBelow(0.5).should_resample(weights.ess(), PARTICLES) {
                let ancestors = Scheme::Systematic.ancestors(
                    &weights,
                    PARTICLES,
                    &mut Stream::at(SEED, Purpose::RESAMPLING, step, 0),
                );
                let died = (0..).zip(&run.living).filter(|(slot, _)| !ancestors.contains(slot));
                run.dead.extend(died.map(|(_, path)| path.clone()));
                run.living = ancestors.iter().map(|ancestor| run.living[*ancestor as usize].clone()).collect();
                weights = Weights::uniform(PARTICLES);
                run.resampled += 1;
            }
        }
        run
    }

    fn left(&self) -> u32 {
        Descent::of(&self.living).lineage(STEPS)
    }

    /// How far from the truth the path ends that ends nearest to it \[m\].
    fn nearest(&self) -> f64 {
        let end = truth()[STEPS as usize];
        let off = |path: &Path| ops::hypot(path.pose().x - end.x, path.pose().y - end.y);
        self.living.iter().map(off).fold(f64::INFINITY, f64::min)
    }
}

/// All paths, those that died out pale, and the truth.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let run = Run::of(at);
    let way = DRIVE.trans * f64::from(STEPS);
    let place = Rect::new(area.x - MARGIN, area.y - MARGIN, area.w + 2.0 * MARGIN, area.h + MARGIN - LINE);
    let plane = Plane { at: [area.x, place.centre()[1]], ..Plane::from_lower_left(place, [0.0; 2], area.w / way) };
    for (paths, role) in [(&run.dead, Role::Fading(130)), (&run.living, Role::Path)] {
        for path in paths {
            scene.lines(plane.path(&path.poses(), 0.0), 1.5, role);
        }
    }
    scene.dashed(plane.path(&truth(), 0.0), 2.5, [6.0, 4.0], Role::Truth);
    let line = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    label(scene, line, Anchor::Start, Role::Path, vignette::lottery_left());
    label(scene, line, Anchor::Middle, Role::Extinct, vignette::lottery_gone());
    label(scene, line, Anchor::End, Role::Truth, vignette::lottery_truth());
}
