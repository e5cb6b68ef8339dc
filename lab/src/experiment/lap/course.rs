//! Where a lap is driven: the courses, and the way through each.

use super::{MAX_RANGE, RING_STEPS, STEPS};
use crate::experiment::ring::closing;
use crate::world::{FloorPlan, corners_cut_short};
use fastslam::error::SettingError;
use fastslam::geometry::Pose2;

/// Where a lap is driven.
#[derive(
    Clone,
    Copy,
    PartialEq,
    Eq,
    Debug,
    Default,
    strum::Display,
    strum::EnumString,
    strum::VariantNames,
    strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_course)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Course {
    /// Out along the corridor of [`FloorPlan::apartment`] and back: nearly all is seen from afar, and seen again.
    #[default]
    Apartment,
    /// Once round [`FloorPlan::ring`] and a little further, with a laser that sees no further than 3 m and two niches on each side of the
    /// block: for most of the way nothing seen has been seen before.
    Ring,
    /// Once round [`FloorPlan::rooms`] and a little further, from door to door, with a laser that sees no further than 3 m.
    Rooms,
}

fn unknown_course(given: &str) -> SettingError {
    SettingError::unknown_word("course", given, <Course as strum::VariantNames>::VARIANTS)
}

impl Course {
    /// Steps, besides the start.
    pub const fn steps(self) -> usize {
        match self {
            Self::Apartment => STEPS,
            Self::Ring | Self::Rooms => RING_STEPS,
        }
    }

    /// The step at which the loop closes: the first that sees the start again after a way on which nothing is seen twice. None in
    /// the apartment, where what was seen once is in sight nearly all the way.
    pub fn closing(self) -> Option<u32> {
        match self {
            Self::Apartment => None,
            Self::Ring | Self::Rooms => closing(&self.route()),
        }
    }

    /// The place and the way through it.
    pub fn route(self) -> Route {
        match self {
            Self::Apartment => Route {
                plan: FloorPlan::apartment(),
                way_points: WAY_POINTS.to_vec(),
                steps: STEPS,
                max_range: MAX_RANGE,
            },
            Self::Ring => Route::ring(2, 3.0),
            Self::Rooms => Route::rooms(),
        }
    }
}

/// A place, a way through it, and how far the laser sees there.
#[derive(Clone, PartialEq, Debug)]
pub struct Route {
    /// The place.
    pub plan: FloorPlan,
    /// What [`drive`](crate::world::drive) goes through \[m\].
    pub way_points: Vec<[f64; 2]>,
    /// Steps, besides the start.
    pub steps: usize,
    /// Longest range of a beam \[m\].
    pub max_range: f64,
}

impl Route {
    /// The ring with so many niches on each side of the block, 0 to 2, and a laser of this range \[m\]: round it against the clock, and
    /// on along the first side. [`RING_STEPS`] steps of some 0.3 m.
    pub fn ring(niches: usize, max_range: f64) -> Self {
        const CORNERS: [[f64; 2]; 6] = [[1.6, 0.9], [10.1, 0.9], [10.1, 7.1], [0.9, 7.1], [0.9, 0.9], [6.6, 0.9]];
        // A drive leaves a leg half-way to the corner: of legs as long as these, it would cut the block's corners.
        let way_points = corners_cut_short(&CORNERS, 1.2);
        Self { plan: FloorPlan::ring(niches), way_points, steps: RING_STEPS, max_range }
    }

    /// Once round [`FloorPlan::rooms`] against the clock and a little further, with a laser that sees no further than 3 m: a loop that
    /// closes in an apartment. 110 steps of some 0.3 m.
    pub fn rooms() -> Self {
        const CORNERS: [[f64; 2]; 11] = [
            [1.6, 1.5],
            [4.0, 1.5],
            [8.0, 1.7],
            [10.4, 1.7],
            [10.6, 7.5],
            [4.0, 7.3],
            [1.6, 7.3],
            [1.5, 3.0],
            [1.6, 1.5],
            [4.0, 1.5],
            [7.0, 1.6],
        ];
        let way_points = corners_cut_short(&CORNERS, 0.9);
        Self { plan: FloorPlan::rooms(), way_points, steps: RING_STEPS, max_range: 3.0 }
    }

    /// The same place and way after a rigid motion of the plane.
    pub fn moved(&self, motion: &Pose2) -> Self {
        let way_points = self.way_points.iter().map(|point| motion.transform(*point)).collect();
        Self { plan: self.plan.moved(motion), way_points, ..*self }
    }
}

/// Out from the west end of the corridor, round the sun room, and back \[m\].
const WAY_POINTS: [[f64; 2]; 9] =
    [[0.7, 4.6], [8.6, 4.6], [9.9, 4.9], [10.1, 6.2], [9.6, 7.6], [10.9, 7.3], [10.6, 5.6], [10.0, 4.8], [0.9, 4.75]];
