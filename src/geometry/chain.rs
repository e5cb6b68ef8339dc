//! A path as a chain of uncertain motions, bent so that it meets what is known of pairs of its poses.
//!
//! Reference: Lu and Milios, *Globally consistent range scan alignment for environment mapping*, Autonomous Robots 1997, with the motions
//! in place of the poses as unknowns, so that only relations take a matrix.

use super::Pose2;
use crate::ops;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix3, Vector3};

/// What is known of two poses of a path.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Relation {
    /// Index of the earlier pose.
    pub from: usize,
    /// Index of the later pose.
    pub to: usize,
    /// The later pose, seen from the earlier.
    pub between: Pose2,
}

/// The poses x_0 … x_n of a path, in which every motion may be off by an error of its own: x_k = x_{k−1} ⊕ u_k ⊕ ξ_k, ξ_k ~ N(0, Q_k) with a
/// diagonal Q_k, independent of all others. Of relations between poses the same is known up to N(0, R).
pub(crate) struct Chain<'a> {
    poses: &'a [Pose2],
    /// Diagonals of Q_1 … Q_n \[m², m², rad²\].
    variances: Vec<Vector3<f64>>,
    /// Diagonal of R.
    relation_variances: Vector3<f64>,
}

/// Gauss–Newton steps of [`Chain::bent`]: the third one moves a path that closes a loop by less than a millimetre.
const STEPS: u32 = 4;

impl<'a> Chain<'a> {
    /// A path, the standard deviations of each of its motions by the index of the pose that it leads to, and those of relations, ahead, aside and of the
    /// heading \[m, m, rad\].
    pub fn new(poses: &'a [Pose2], motion_stds: impl Fn(usize, &Pose2) -> [f64; 3], relation_stds: [f64; 3]) -> Self {
        let square = |stds: [f64; 3]| Vector3::from(stds.map(|std| std * std));
        let stds = |to: usize| square(motion_stds(to, &poses[to - 1].between(&poses[to])));
        let variances = (1..poses.len()).map(stds).collect();
        Self { poses, variances, relation_variances: square(relation_stds) }
    }

    /// Covariance of the pose `to` as seen from the pose `from`, in the axes of the latter, given that these relations are as the path has
    /// them.
    ///
    /// `None` where rounding leaves no positive definite matrix.
    pub fn covariance(&self, relations: &[Relation], from: usize, to: usize) -> Option<Matrix3<f64>> {
        let errors = Errors::of(self.poses, &self.variances);
        let new = [Row::of(self.poses, from, to)];
        let prior = errors.shared(&new[0], &new[0]);
        if relations.is_empty() {
            return Some(prior);
        }
        let known: Vec<Row> = relations.iter().map(|known| Row::of(self.poses, known.from, known.to)).collect();
        let cross = errors.gram(&known, &new);
        let explained = cross.transpose() * self.factor(&errors, &known)?.solve(&cross);
        Some(prior - Matrix3::from_fn(|i, j| explained[(i, j)]))
    }

    /// The most likely path under these relations: the errors of all motions with the least Σ ξ_kᵀ Q_k⁻¹ ξ_k and misfit of the relations.
    /// Poses before all relations stay.
    ///
    /// By Gauss and Newton: with J the derivatives of what relations tell, r their misfit and Q and R block diagonal,
    /// ξ ← Q Jᵀ (J Q Jᵀ + R)⁻¹ (r + J ξ). Takes O(n + m³) for n motions and m relations.
    ///
    /// `None` where rounding leaves no positive definite matrix, or no finite pose.
    pub fn bent(&self, relations: &[Relation]) -> Option<Vec<Pose2>> {
        let motions: Vec<Pose2> = self.poses.windows(2).map(|pair| pair[0].between(&pair[1])).collect();
        let mut xi = vec![Vector3::zeros(); motions.len()];
        let mut poses = self.poses.to_vec();
        let first = relations.iter().map(|known| known.from).min().unwrap_or(motions.len());
        for _ in 0..STEPS {
            let errors = Errors::of(&poses, &self.variances);
            let rows: Vec<Row> = relations.iter().map(|known| Row::of(&poses, known.from, known.to)).collect();
            let moved = errors.moved(&xi);
            let misfits = rows.iter().zip(relations).flat_map(|(row, known)| {
                let misfit = known.between.minus(&poses[known.from].between(&poses[known.to]));
                <[f64; 3]>::from(misfit + row.lever * (moved[row.to] - moved[row.from]))
            });
            let misfits = DVector::from_iterator(3 * rows.len(), misfits);
            let forces = self.factor(&errors, &rows)?.solve(&misfits);
            // Each relation pulls at the motions between its poses.
            let mut pulls = vec![Vector3::<f64>::zeros(); poses.len()];
            for (j, row) in rows.iter().enumerate() {
                let pull = row.lever.transpose() * forces.fixed_rows::<3>(3 * j);
                pulls[row.from] += pull;
                pulls[row.to] -= pull;
            }
            let mut pull = Vector3::zeros();
            for (k, motion) in motions.iter().enumerate().skip(first) {
                pull += pulls[k];
                xi[k] = self.variances[k].component_mul(&(errors.adjoints[k].transpose() * pull));
                poses[k + 1] = poses[k].compose(motion).compose(&Pose2::new(xi[k].x, xi[k].y, xi[k].z));
            }
        }
        let finite = |pose: &Pose2| pose.x.is_finite() && pose.y.is_finite() && pose.theta.is_finite();
        poses.iter().all(finite).then_some(poses)
    }

    /// J Q Jᵀ + R, factored.
    fn factor(&self, errors: &Errors, rows: &[Row]) -> Option<Cholesky<f64, Dyn>> {
        let mut matrix = errors.gram(rows, rows);
        for k in 0..matrix.nrows() {
            matrix[(k, k)] += self.relation_variances[k % 3];
        }
        Cholesky::new(matrix)
    }
}

/// The errors of all motions, as rigid motions of the world: there, errors of motions one after the other add up.
struct Errors {
    /// Of each motion, what carries an error in the frame of the pose that it leads to into the world's ([`adjoint`]).
    adjoints: Vec<Matrix3<f64>>,
    /// Covariance of the sum over the first k motions.
    covariances: Vec<Matrix3<f64>>,
}

impl Errors {
    fn of(poses: &[Pose2], variances: &[Vector3<f64>]) -> Self {
        let adjoints: Vec<Matrix3<f64>> = poses.iter().skip(1).map(adjoint).collect();
        let covariance = |(adjoint, variance): (&Matrix3<f64>, &Vector3<f64>)| {
            adjoint * Matrix3::from_diagonal(variance) * adjoint.transpose()
        };
        let covariances = running_sums(adjoints.iter().zip(variances).map(covariance), Matrix3::zeros());
        Self { adjoints, covariances }
    }

    /// The sum over the first k of these errors, each in the frame of its pose.
    fn moved(&self, xi: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        running_sums(self.adjoints.iter().zip(xi).map(|(adjoint, xi)| adjoint * xi), Vector3::zeros())
    }

    /// The matrix of [`Self::shared`] for each of these with each of those.
    fn gram(&self, these: &[Row], those: &[Row]) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(3 * these.len(), 3 * those.len());
        for (i, this) in these.iter().enumerate() {
            for (j, that) in those.iter().enumerate() {
                matrix.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&self.shared(this, that));
            }
        }
        matrix
    }

    /// Covariance of what two relations tell, by the motions that both depend on.
    fn shared(&self, this: &Row, that: &Row) -> Matrix3<f64> {
        let (first, last) = (this.from.max(that.from), this.to.min(that.to));
        if first >= last {
            return Matrix3::zeros();
        }
        this.lever * (self.covariances[last] - self.covariances[first]) * that.lever.transpose()
    }
}

/// What one relation tells of the errors of the motions between its poses; it does not depend on others.
struct Row {
    /// Index of the earlier pose, and of the first motion.
    from: usize,
    /// Index of the later pose, one past the last motion.
    to: usize,
    /// What makes of a motion of the world how the later pose moves, as seen from the earlier.
    lever: Matrix3<f64>,
}

impl Row {
    fn of(poses: &[Pose2], from: usize, to: usize) -> Self {
        let later = poses[from].between(&poses[to]);
        let lever = Matrix3::new(1.0, 0.0, -later.y, 0.0, 1.0, later.x, 0.0, 0.0, 1.0);
        Self { from, to, lever: lever * adjoint(&poses[from].between(&Pose2::default())) }
    }
}

/// Ad(x): a small rigid motion in the frame of x, as (ahead, aside, turn), in the frame that x is given in, as the motion of its origin.
fn adjoint(pose: &Pose2) -> Matrix3<f64> {
    let (sin, cos) = ops::sin_cos(pose.theta);
    Matrix3::new(cos, -sin, pose.y, sin, cos, -pose.x, 0.0, 0.0, 1.0)
}

/// Sums of the first k of these, from k = 0 on.
fn running_sums<T: Copy + core::ops::AddAssign>(terms: impl Iterator<Item = T>, zero: T) -> Vec<T> {
    let mut sum = zero;
    let sums = terms.map(|term| {
        sum += term;
        sum
    });
    core::iter::once(zero).chain(sums).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    const RELATION_STDS: [f64; 3] = [0.01, 0.01, 0.002];

    fn stds(_: usize, motion: &Pose2) -> [f64; 3] {
        let way = ops::hypot(motion.x, motion.y).sqrt();
        [0.03 * way, 0.02 * way, 0.01 * way]
    }

    /// Once round a square of 40 m, and on for 20 m.
    fn square() -> Vec<Pose2> {
        let mut poses = vec![Pose2::default()];
        for k in 1..=60 {
            let turn = if k % 10 == 0 { core::f64::consts::FRAC_PI_2 } else { 0.0 };
            poses.push(poses[k - 1].compose(&Pose2::new(1.0, 0.0, turn)));
        }
        poses
    }

    fn relation(poses: &[Pose2], from: usize, to: usize) -> Relation {
        Relation { from, to, between: poses[from].between(&poses[to]) }
    }

    /// The same with every motion off by its noise.
    fn drifted(poses: &[Pose2], seed: u64) -> Vec<Pose2> {
        let mut drifted = vec![poses[0]];
        for (k, pair) in poses.windows(2).enumerate() {
            let (motion, [a, b, c]) =
                (pair[0].between(&pair[1]), Stream::at(seed, Purpose::TRIAL, k as u32, 0).normals());
            let [ahead, aside, turn] = stds(k + 1, &motion);
            drifted.push(drifted[k].compose(&motion).compose(&Pose2::new(ahead * a, aside * b, turn * c)));
        }
        drifted
    }

    #[test]
    fn a_bent_path_meets_all_that_is_known_of_it_and_is_nearer_to_the_truth() {
        let truth = square();
        let known = [(0, 40), (5, 45), (12, 52), (20, 60)].map(|(from, to)| relation(&truth, from, to));
        let (mut before, mut after) = (0.0, 0.0);
        for seed in 1..=20 {
            let poses = drifted(&truth, seed);
            let bent = Chain::new(&poses, stds, RELATION_STDS).bent(&known).unwrap();
            for Relation { from, to, between } in known {
                let misfit = bent[from].between(&bent[to]).minus(&between);
                assert!(misfit.norm() < 0.03, "seed {seed}, {from} to {to}: {misfit}");
            }
            before += super::super::rms(&poses, &truth);
            after += super::super::rms(&bent, &truth);
        }
        // Half of what is wrong on the way out nothing tells of.
        assert!(after < 0.6 * before, "{after} of {before} m");
    }

    /// One motion is off, by which a loop does not close. Where it is known which, bending puts the path right, and else it does not.
    #[test]
    fn a_path_gives_way_first_where_it_is_doubted() {
        let truth = square();
        let off = Pose2::new(0.4, -0.3, 0.15);
        let poses: Vec<Pose2> = (0..truth.len())
            .map(|k| if k < 15 { truth[k] } else { truth[14].compose(&off).compose(&truth[14].between(&truth[k])) })
            .collect();
        let doubted = |to: usize, motion: &Pose2| if to == 15 { [2.0, 2.0, 1.0] } else { stds(to, motion) };
        let farthest = |bent: Vec<Pose2>| bent.iter().zip(&truth).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
        let known = [relation(&truth, 0, 40)];
        let error = farthest(Chain::new(&poses, doubted, RELATION_STDS).bent(&known).unwrap());
        assert!(error < 0.1, "{error} m");
        let error = farthest(Chain::new(&poses, stds, RELATION_STDS).bent(&known).unwrap());
        assert!(error > 0.3, "{error} m");
    }

    /// What a path was bent by before is not undone by what comes later.
    #[test]
    fn a_loop_that_is_closed_stays_closed_when_another_closes() {
        let poses = drifted(&square(), 3);
        let closed = relation(&poses, 3, 43);
        let wanted = Relation {
            between: poses[25].between(&poses[58]).plus(&[0.6, -0.8, 0.05].into()),
            ..relation(&poses, 25, 58)
        };
        let chain = Chain::new(&poses, stds, RELATION_STDS);
        let moved = |relations: &[Relation]| {
            let bent = chain.bent(relations).unwrap();
            bent[3].between(&bent[43]).minus(&closed.between).norm()
        };
        assert!(moved(&[wanted]) > 0.1, "{}", moved(&[wanted]));
        assert!(moved(&[closed, wanted]) < 0.02, "{}", moved(&[closed, wanted]));
    }

    #[test]
    fn a_path_that_tells_nothing_new_is_not_moved() {
        let poses = drifted(&square(), 5);
        let known = [relation(&poses, 0, 40), relation(&poses, 20, 60)];
        let bent = Chain::new(&poses, stds, RELATION_STDS).bent(&known).unwrap();
        assert!(bent.iter().zip(&poses).all(|(bent, pose)| bent.minus(pose).norm() < 1e-9));
    }

    /// α = 0.001 for each of three variances, n = 2000: 1 ± 0.11.
    #[test]
    fn the_covariance_is_that_of_paths_that_drift() {
        let truth = square();
        let (from, to, n) = (4, 33, 2000);
        let expected = Chain::new(&truth, stds, RELATION_STDS).covariance(&[], from, to).unwrap();
        let seen = truth[from].between(&truth[to]);
        let mut sum = Vector3::zeros();
        for seed in 0..n {
            let poses = drifted(&truth, seed);
            let error = poses[from].between(&poses[to]).minus(&seen);
            sum += error.component_mul(&error) / n as f64;
        }
        for k in 0..3 {
            assert!((sum[k] / expected[(k, k)] - 1.0).abs() < 0.11, "{k}: {} of {}", sum[k], expected[(k, k)]);
        }
    }

    #[test]
    fn what_is_known_of_a_loop_makes_its_poses_more_certain() {
        let poses = square();
        let chain = Chain::new(&poses, stds, RELATION_STDS);
        let free = chain.covariance(&[], 0, 45).unwrap();
        let known = chain.covariance(&[relation(&poses, 0, 40)], 0, 45).unwrap();
        // Five metres of drift and what the relation is off by are left of 45.
        assert!((0..3).all(|k| known[(k, k)] < 0.2 * free[(k, k)] && known[(k, k)] > 0.0), "{known} of {free}");
        let same = chain.covariance(&[relation(&poses, 0, 45)], 0, 45).unwrap();
        assert!((0..3).all(|k| same[(k, k)] < 1.01 * RELATION_STDS[k] * RELATION_STDS[k]), "{same}");
    }
}
