//! The doors over many seeds.

use super::recipe::Recipe;
use crate::told::refused;
use crate::{
    job::{self, Counted, Job, Rows, Setting},
    model::FigureError,
};
use core::ops::Range;
use fastslam_lab::experiment::doors::{DoorsSetup, outcomes};

/// Numbers of particles that are counted.
const PARTICLES: [usize; 3] = [25, 100, 400];

/// Who ends at the robot, and how often the EKF should.
pub static DOORS: Job = Job {
    name: "doors",
    columns: &["seed", "ekf", "m25", "m100", "m400", "pencil"],
    run,
    counted: Some(Counted {
        title: "count_doors",
        settings: "ride proposal price range gate policy threshold door-1 door-2 door-3 door-4 door-5 door-6 door-7",
        rows: &[
            ("ekf_slam", "ekf", Some("pencil")),
            ("m_25", "m25", None),
            ("m_100", "m100", None),
            ("m_400", "m400", None),
        ],
    }),
};

/// The setting is that of the figure's link; what it says about seed, number of particles, the end of the
/// ride and the view makes no difference.
fn run(setting: &Setting, seeds: Range<u64>) -> Result<Rows, FigureError> {
    let setup = DoorsSetup { end: None, ..job::recipe::<Recipe>(setting)?.setup() };
    let of = |particles| outcomes(&DoorsSetup { particles, ..setup.clone() }, seeds.clone()).map_err(refused);
    let [few, some, many] = PARTICLES.map(of);
    let (few, some, many) = (few?, some?, many?);
    let row = |(k, seed): (usize, u64)| {
        let right = [few[k].ekf_right, few[k].fastslam_right, some[k].fastslam_right, many[k].fastslam_right];
        let right = right.map(|right| f64::from(u8::from(right)));
        [&[seed as f64], &right[..], &[setup.pencil()]].concat()
    };
    Ok(seeds.enumerate().map(row).collect())
}
