//! A short drive past landmarks, for which the whole joint Gaussian over path and map is computed: what is known of the map with
//! the path marginalised out, and what is known of it given the path.
//!
//! Everything is linearised at the truth and no noise is drawn: covariances do not depend on it, so there is no seed.

use crate::baseline::information_matrix::{InformationMatrix, MapCovariance, PairPrediction};
use crate::digest::Digest;
use crate::world::drive;
use fastslam::error::{Range, SettingError};
use fastslam::geometry::Pose2;
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix3, Vector2, Vector3};
use fastslam::sensor::{LandmarkSensor, RangeBearing};

/// Extent of the place \[m\] along x and y, from the origin.
pub const SIZE: [f64; 2] = [8.0, 6.0];

/// Noise of the wheels at scale 1, some centimetres and degrees a metre: α₁ \[–\], α₂ \[rad²/m²\], α₃ \[–\], α₄ \[m²/rad²\].
pub const ALPHAS: [f64; 4] = [0.003, 0.0006, 0.0016, 0.0006];

/// Standard deviations \[m, m, rad\] whose squares are added to R_t. At scale 0 wheels make no error and R_t has no inverse; a
/// hundredth of a millimetre gives it one, and couples no two landmarks by more than a ten-thousandth.
pub const FLOOR_STDS: [f64; 3] = [1e-5; 3];

/// σ_φ \[rad\].
pub const BEARING_STD: f64 = 0.05;

/// Standard deviation of the angle between two landmarks \[rad\], where the sensor reads it: in one look, what spoils a bearing spoils
/// both.
pub const ANGLE_STD: f64 = 0.01;

/// Longest range \[m\]. Shorter than the drive is long: most pairs of landmarks are never seen from one pose.
pub const MAX_RANGE: f64 = 2.6;

/// Numbers of landmarks and of poses that can be set.
pub const LANDMARKS: Range = Range::whole(3, 24);
/// See [`LANDMARKS`].
pub const POSES: Range = Range::whole(2, 12);

/// There, across, and back beside the way there: the landmarks in the middle are seen twice.
const WAY: [[f64; 2]; 4] = [[1.0, 1.4], [6.8, 1.4], [6.8, 4.6], [1.0, 4.6]];

/// Nearest and farthest that a landmark is from the way \[m\]: clear of the drawing of the path, and in range of it.
const CLEAR: [f64; 2] = [0.6, 1.5];

/// Distance of the places a landmark can have \[m\].
const GRID: f64 = 0.2;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct ConditioningSetup {
    /// Number of landmarks N, 3 to 24.
    pub landmarks: usize,
    /// Number of poses T besides the known start, 2 to 12: the same drive in as many steps.
    pub poses: usize,
    /// Factor on the standard deviations of the odometry's noise, 0 to 10.
    pub odometry_scale: f64,
    /// σ_r \[m\], 0.001 to 1.
    pub range_std: f64,
    /// Whether each look also reads the angles between neighbours in view: readings of two landmarks, for which the map does not fall
    /// apart given the path.
    pub pairs: bool,
}

impl Default for ConditioningSetup {
    fn default() -> Self {
        Self { landmarks: 7, poses: 8, odometry_scale: 1.0, range_std: 0.1, pairs: false }
    }
}

impl ConditioningSetup {
    fn check(&self) -> Result<(), SettingError> {
        LANDMARKS.check("landmarks", self.landmarks as f64)?;
        POSES.check("poses", self.poses as f64)?;
        Range::number(0.0, 10.0, "").check("odometry_scale", self.odometry_scale)?;
        Range::number(0.001, 1.0, "m").check("range_std", self.range_std).map(drop)
    }
}

/// The drive, and what is seen on it.
#[derive(Clone, PartialEq, Debug)]
pub struct Conditioning {
    setup: ConditioningSetup,
    path: Vec<Pose2>,
    landmarks: Vec<[f64; 2]>,
}

/// What is known after some of the poses.
#[derive(Clone, PartialEq, Debug)]
pub struct Covariances {
    /// The landmarks seen so far, in ascending order: what the covariances are of.
    pub seen: Vec<usize>,
    /// Σ_m with the path marginalised out.
    pub marginal: MapCovariance,
    /// Σ_m given the path.
    pub conditional: MapCovariance,
    /// Σ_m given the last pose alone.
    pub given_last: MapCovariance,
    /// Covariances of the poses x_1 … x_t (3 × 3, \[m, m, rad\]).
    pub path: Vec<Matrix3<f64>>,
    /// The same of all but x_t, given that one.
    pub path_given_last: Vec<Matrix3<f64>>,
}

impl Conditioning {
    /// Errors name the parameter of the setup that is out of its range.
    pub fn new(setup: &ConditioningSetup) -> Result<Self, SettingError> {
        setup.check()?;
        Ok(Self { setup: setup.clone(), path: drive(&WAY, setup.poses), landmarks: places(setup.landmarks) })
    }

    /// What was set.
    pub fn setup(&self) -> &ConditioningSetup {
        &self.setup
    }

    /// x_0 … x_T.
    pub fn path(&self) -> &[Pose2] {
        &self.path
    }

    /// m_1 … m_N \[m\], in the order in which the drive comes by them.
    pub fn landmarks(&self) -> &[[f64; 2]] {
        &self.landmarks
    }

    fn sensor(&self) -> RangeBearing {
        let field_of_view = core::f64::consts::TAU;
        RangeBearing { range_std: self.setup.range_std, bearing_std: BEARING_STD, max_range: MAX_RANGE, field_of_view }
    }

    /// The landmarks in range of pose `t`, in ascending order. From the known start the robot does not look.
    pub fn sightings(&self, t: usize) -> Vec<usize> {
        let sees = |at: &[f64; 2]| self.sensor().sees(&self.path[t], &Vector2::from(*at), 0.0);
        (0..self.landmarks.len()).filter(|&j| t > 0 && sees(&self.landmarks[j])).collect()
    }

    /// What is known when `poses` of the poses have been driven, 0 to T.
    pub fn after(&self, poses: usize) -> Covariances {
        let sightings: Vec<Vec<usize>> = (0..=poses).map(|t| self.sightings(t)).collect();
        let seen: Vec<usize> =
            (0..self.landmarks.len()).filter(|j| sightings.iter().any(|from| from.contains(j))).collect();
        let (motion, sensor) = (OdometryModel { alphas: ALPHAS }.scaled(self.setup.odometry_scale), self.sensor());
        let floor = Matrix3::from_diagonal(&Vector3::from(FLOOR_STDS.map(|std| std * std)));
        let mut information = InformationMatrix::new(poses, seen.len());
        for (t, visible) in sightings.iter().enumerate().skip(1) {
            let (from, to) = (&self.path[t - 1], &self.path[t]);
            let u = Odometry::between(from, to);
            information.add_odometry(t, &motion.jacobian(from, &u), &(motion.covariance(from, &u) + floor));
            let in_view: Vec<_> = seen
                .iter()
                .enumerate()
                .filter(|(_, j)| visible.contains(j))
                .map(|(row, &j)| (row, sensor.predict(to, &Vector2::from(self.landmarks[j]))))
                .collect();
            for (row, predicted) in &in_view {
                information.add_observation(t, *row, predicted, &sensor.noise());
            }
            for pair in in_view.windows(2).filter(|_| self.setup.pairs) {
                let [(one, seen_one), (two, seen_two)] = pair else { continue };
                information.add_pair(t, [*one, *two], &PairPrediction::angle([seen_one, seen_two]), ANGLE_STD);
            }
        }
        let known = "every landmark in it was sighted, and every range is checked";
        let conditional = information.conditional().expect(known);
        // Wheels without error leave nothing of the path open: it is known, whatever it is asked for.
        if self.setup.odometry_scale == 0.0 || poses == 0 {
            return Covariances {
                seen,
                marginal: conditional.clone(),
                given_last: conditional.clone(),
                conditional,
                path: vec![Matrix3::zeros(); poses],
                path_given_last: vec![Matrix3::zeros(); poses.saturating_sub(1)],
            };
        }
        Covariances {
            marginal: information.marginal().expect(known),
            given_last: information.given_last_pose().expect(known),
            conditional,
            path: information.path(poses).expect(known),
            path_given_last: information.path(poses - 1).expect(known),
            seen,
        }
    }

    /// Every covariance after every pose, as a fingerprint.
    pub fn trace(&self) -> Digest {
        let mut digest = Digest::new();
        for poses in 0..=self.setup.poses {
            let Covariances { seen, marginal, conditional, path, .. } = self.after(poses);
            seen.iter().for_each(|&j| digest.u32(j as u32));
            [marginal, conditional].iter().flat_map(|map| map.matrix()).for_each(|&x| digest.f64(x));
            path.iter().flatten().for_each(|&x| digest.f64(x));
        }
        digest
    }
}

/// The places of so many landmarks \[m\]: each the farthest there is from all before it, so that more landmarks leave the others
/// where they were. Numbered in the order in which the way comes by.
fn places(count: usize) -> Vec<[f64; 2]> {
    let way = drive(&WAY, 140);
    let squared = |[x, y]: [f64; 2], [u, v]: [f64; 2]| (x - u) * (x - u) + (y - v) * (y - v);
    // Where on the way a place is passed, and at what squared distance.
    let passed = |place: [f64; 2]| {
        let distances = way.iter().map(|pose| squared(place, [pose.x, pose.y])).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).expect("the way has poses")
    };
    let [columns, rows] = SIZE.map(|side| (side / GRID) as usize);
    let grid = (2..columns - 1).flat_map(|i| (2..rows - 1).map(move |j| [i as f64 * GRID, j as f64 * GRID]));
    let clear = CLEAR.map(|distance| distance * distance);
    // Each with its squared distance from the nearest landmark so far.
    let mut free: Vec<([f64; 2], f64)> =
        grid.filter(|&p| clear[0] <= passed(p).1 && passed(p).1 <= clear[1]).map(|p| (p, f64::INFINITY)).collect();
    let mut chosen = Vec::with_capacity(count);
    for _ in 0..count {
        let (place, _) =
            free.iter().rev().max_by(|a, b| a.1.total_cmp(&b.1)).copied().expect("the place is large enough");
        free.iter_mut().for_each(|(p, nearest)| *nearest = nearest.min(squared(*p, place)));
        let when = passed(place).0;
        let before = chosen.partition_point(|&(other, _)| other <= when);
        chosen.insert(before, (when, place));
    }
    chosen.into_iter().map(|(_, place)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(landmarks: usize, poses: usize) -> Conditioning {
        Conditioning::new(&ConditioningSetup { landmarks, poses, ..ConditioningSetup::default() }).unwrap()
    }

    #[test]
    fn every_setup_has_its_landmarks_apart_and_the_ends_of_every_range_are_computed() {
        for landmarks in LANDMARKS.least as usize..=LANDMARKS.most as usize {
            let drive = at(landmarks, 8);
            let seen = drive.after(8).seen;
            assert_eq!(seen.len(), landmarks, "of {landmarks} landmarks some were never seen");
            for (k, a) in drive.landmarks().iter().enumerate() {
                let [x, y] = *a;
                assert!(0.3 < x && x < SIZE[0] - 0.3 && 0.3 < y && y < SIZE[1] - 0.3);
                for b in &drive.landmarks()[..k] {
                    assert!(Vector2::from([x - b[0], y - b[1]]).norm() > 0.7, "{landmarks}: {a:?} and {b:?}");
                }
            }
        }
        for (landmarks, poses) in [(3, 2), (3, 12), (24, 2), (24, 12)] {
            for (odometry_scale, range_std) in [(0.0, 0.001), (0.0, 1.0), (10.0, 0.001), (10.0, 1.0)] {
                let drive =
                    Conditioning::new(&ConditioningSetup { landmarks, poses, odometry_scale, range_std, pairs: false })
                        .unwrap();
                let Covariances { marginal, conditional, .. } = drive.after(poses);
                for map in [&marginal, &conditional] {
                    assert!((0..map.landmarks()).all(|j| map.block(j, j).cholesky().is_some()));
                }
                assert_eq!(conditional.off_block_nonzeros(), 0);
            }
        }
    }

    #[test]
    fn more_landmarks_leave_the_others_where_they_were() {
        for count in LANDMARKS.least as usize..LANDMARKS.most as usize {
            let (fewer, more) = (places(count), places(count + 1));
            assert!(fewer.iter().all(|place| more.contains(place)), "{count}");
        }
    }

    #[test]
    fn what_is_known_grows_with_the_drive() {
        let drive = at(7, 8);
        let (before, after) = (drive.after(0), drive.after(4));
        assert_eq!((before.seen.len(), before.path.len(), before.marginal.landmarks()), (0, 0, 0));
        assert!(after.seen.len() > 1 && after.seen.len() < 7 && after.path.len() == 4, "{after:?}");
    }

    /// The path tells more than marginalising it does: no direction of any landmark is known less well given the path.
    #[test]
    fn given_the_path_every_landmark_is_known_better() {
        let Covariances { marginal, conditional, .. } = at(12, 8).after(8);
        for j in 0..12 {
            assert!((marginal.block(j, j) - conditional.block(j, j)).cholesky().is_some(), "{j}");
        }
    }

    #[test]
    fn without_noise_of_the_wheels_the_path_is_known_and_nothing_is_coupled() {
        let setup = ConditioningSetup { odometry_scale: 0.0, landmarks: 24, poses: 12, range_std: 0.05, pairs: false };
        let none = Conditioning::new(&setup).unwrap().after(12);
        assert_eq!(none.marginal.off_block_nonzeros(), 0);
        assert_eq!(none.marginal, none.conditional);
        // And that is what less and less noise comes to.
        let little = ConditioningSetup { odometry_scale: 1e-3, ..setup };
        let map = Conditioning::new(&little).unwrap().after(12).marginal;
        let largest =
            (0..24).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| map.coupling(i, j)).fold(0.0, f64::max);
        assert!(largest < 1e-3, "{largest}");
    }

    /// d-separation needs the whole path: one pose of it blocks only the ways through that pose.
    #[test]
    fn given_the_last_pose_alone_landmarks_stay_coupled_but_less_is_open() {
        let Covariances { marginal, conditional, given_last, .. } = at(12, 8).after(8);
        assert_eq!(given_last.off_block_nonzeros(), 4 * 12 * 11);
        for j in 0..12 {
            assert!((marginal.block(j, j) - given_last.block(j, j)).cholesky().is_some(), "{j}");
            assert!((given_last.block(j, j) - conditional.block(j, j)).cholesky().is_some(), "{j}");
        }
        // After one pose, the last is the path.
        let first = at(12, 8).after(1);
        assert_eq!(first.given_last, first.conditional);
    }

    #[test]
    fn a_sensor_that_reads_two_landmarks_couples_them_even_given_the_path() {
        let setup = ConditioningSetup { pairs: true, ..ConditioningSetup::default() };
        let drive = Conditioning::new(&setup).unwrap();
        let (with, without) = (drive.after(8).conditional, at(7, 8).after(8).conditional);
        assert_eq!(without.off_block_nonzeros(), 0);
        let read_together =
            |i: usize, j: usize| (1..=8).any(|t| drive.sightings(t).windows(2).any(|pair| pair == [i, j]));
        let pairs: Vec<(usize, usize)> = (0..7).flat_map(|j| (0..j).map(move |i| (i, j))).collect();
        assert!(pairs.iter().any(|&(i, j)| read_together(i, j)));
        for (i, j) in pairs.into_iter().filter(|&(i, j)| read_together(i, j)) {
            assert!(with.coupling(i, j) > 0.05, "m{i} and m{j}: {}", with.coupling(i, j));
        }
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let bad = |setup: ConditioningSetup| Conditioning::new(&setup).unwrap_err().to_string();
        let default = ConditioningSetup::default;
        assert_eq!(
            bad(ConditioningSetup { poses: 13, ..default() }),
            "poses = 13: must be a whole number from 2 to 12"
        );
        assert!(bad(ConditioningSetup { landmarks: 2, ..default() }).starts_with("landmarks = 2"));
        assert!(bad(ConditioningSetup { odometry_scale: f64::NAN, ..default() }).contains("odometry_scale"));
        assert!(bad(ConditioningSetup { range_std: 0.0, ..default() }).contains("from 0.001 to 1 [m]"));
    }
}
