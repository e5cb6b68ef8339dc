//! The joint Gaussian over a path and the landmarks seen from it, in information form.
//!
//! Every motion and every sighting adds its own small block to one sparse matrix Λ, the inverse of the covariance. Two ways
//! lead from Λ to a covariance of the landmarks, and the difference between them is what FastSLAM stands on:
//!
//! - *marginalise* the path, and every landmark depends on every other: Σ_m = (Λ_mm − Λ_mx Λ_xx⁻¹ Λ_xm)⁻¹ is dense;
//! - *condition* on the path, and none depends on any other: Σ_m|x = Λ_mm⁻¹ is block diagonal, because a sighting is of one
//!   landmark and no factor has two of them.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit, *FastSLAM* (AAAI 2002); Thrun, Burgard, Fox, *Probabilistic Robotics* (2005),
//! §11.4 and §13.3.

use fastslam::nalgebra::{Cholesky, DMatrix, DMatrixView, Dyn, Matrix2, Matrix2x3, Matrix3, RowVector2, RowVector3};
use fastslam::sensor::Prediction;

/// What a reading of two landmarks depends on, linearised.
#[derive(Clone, PartialEq, Debug)]
pub struct PairPrediction {
    /// ∂z/∂x (1 × 3).
    pub h_x: RowVector3<f64>,
    /// ∂z/∂m of each landmark (1 × 2).
    pub h_m: [RowVector2<f64>; 2],
}

impl PairPrediction {
    /// The angle between two landmarks \[rad\], as the difference of their bearings.
    pub fn angle([one, two]: [&Prediction; 2]) -> Self {
        Self { h_x: two.h_x.row(1) - one.h_x.row(1), h_m: [-one.h_m.row(1), two.h_m.row(1).into()] }
    }
}

/// Λ over the poses x_1 … x_T (three numbers each; x_0 is known) and the landmarks m_1 … m_N (two each).
#[derive(Clone, PartialEq, Debug)]
pub struct InformationMatrix {
    poses: usize,
    landmarks: usize,
    /// 3 T + 2 N rows: all poses, then all landmarks.
    information: DMatrix<f64>,
}

impl InformationMatrix {
    /// Of so many poses besides the known start, and so many landmarks, of which nothing is known yet.
    pub fn new(poses: usize, landmarks: usize) -> Self {
        let size = 3 * poses + 2 * landmarks;
        Self { poses, landmarks, information: DMatrix::zeros(size, size) }
    }

    /// The motion to pose `to`, 1 to T: x_t = F x_{t−1} + noise, with F = ∂g/∂x and R_t (3 × 3, \[m, m, rad\]).
    ///
    /// # Panics
    /// For an R_t that is not positive definite, as of a robot that stands still: add a floor to its diagonal. Also for a
    /// pose that is not there.
    pub fn add_odometry(&mut self, to: usize, jacobian: &Matrix3<f64>, noise: &Matrix3<f64>) {
        let weight = Cholesky::new(*noise).expect("R_t has to be positive definite").inverse();
        let (now, carried) = (self.pose(to), weight * jacobian);
        self.add(now, now, &weight);
        if to > 1 {
            let before = self.pose(to - 1);
            self.add(before, before, &(jacobian.transpose() * carried));
            self.add(now, before, &-carried);
            self.add(before, now, &-carried.transpose());
        }
    }

    /// A sighting from pose `from`, 1 to T, of a landmark, 0 to N − 1: z = H_x x + H_m m + noise of covariance Q (2 × 2).
    ///
    /// # Panics
    /// For a Q that is not positive definite, a pose or a landmark that is not there.
    pub fn add_observation(&mut self, from: usize, landmark: usize, seen: &Prediction, noise: &Matrix2<f64>) {
        let weight = Cholesky::new(*noise).expect("Q has to be positive definite").inverse();
        let (x, m) = (self.pose(from), self.landmark(landmark));
        let (h_x, h_m): (&Matrix2x3<f64>, &Matrix2<f64>) = (&seen.h_x, &seen.h_m);
        let cross = h_x.transpose() * weight * h_m;
        self.add(x, x, &(h_x.transpose() * weight * h_x));
        self.add(m, m, &(h_m.transpose() * weight * h_m));
        self.add(x, m, &cross);
        self.add(m, x, &cross.transpose());
    }

    /// A reading from pose `from`, 1 to T, of two landmarks at once: z = h_x x + h_1 m_1 + h_2 m_2 + noise of standard deviation σ.
    ///
    /// # Panics
    /// For a σ that is not positive, a pose or a landmark that is not there.
    pub fn add_pair(&mut self, from: usize, landmarks: [usize; 2], seen: &PairPrediction, std: f64) {
        assert!(std > 0.0, "σ has to be positive");
        let (x, weight) = (self.pose(from), 1.0 / (std * std));
        let [one, two] = landmarks.map(|landmark| self.landmark(landmark));
        let [h_one, h_two] = seen.h_m;
        self.add(x, x, &(seen.h_x.transpose() * weight * seen.h_x));
        for (row, h_row) in [(one, h_one), (two, h_two)] {
            let cross = seen.h_x.transpose() * weight * h_row;
            self.add(x, row, &cross);
            self.add(row, x, &cross.transpose());
            for (column, h_column) in [(one, h_one), (two, h_two)] {
                self.add(row, column, &(h_row.transpose() * weight * h_column));
            }
        }
    }

    /// Λ (3 T + 2 N rows): all poses, then all landmarks.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.information
    }

    /// Covariance of the landmarks with the path marginalised out; `None` where a landmark was never sighted.
    pub fn marginal(&self) -> Option<MapCovariance> {
        let path = 0..3 * self.poses;
        let map = path.end..self.information.nrows();
        self.marginalize(map, path).map(MapCovariance)
    }

    /// Covariance of the landmarks given the path; `None` where a landmark was never sighted.
    ///
    /// Λ_mm is inverted as any other matrix: that it falls into blocks is not made use of, it is found.
    pub fn conditional(&self) -> Option<MapCovariance> {
        let map = 3 * self.poses;
        inverse(self.information.view_range(map.., map..)).map(MapCovariance)
    }

    /// Covariance of the landmarks given the last pose alone, the poses before it marginalised out; `None` where a landmark was never
    /// sighted.
    ///
    /// # Panics
    /// Without any pose.
    pub fn given_last_pose(&self) -> Option<MapCovariance> {
        let known = self.pose(self.poses);
        let map = 3 * self.poses..self.information.nrows();
        self.marginalize(map, 0..known).map(MapCovariance)
    }

    /// Covariances of the first `open` of the poses x_1 … x_T (3 × 3, \[m, m, rad\]), given the others, with the map marginalised out;
    /// `None` where a landmark was never sighted.
    pub fn path(&self, open: usize) -> Option<Vec<Matrix3<f64>>> {
        let map = 3 * self.poses..self.information.nrows();
        let all = self.marginalize(0..3 * open, map)?;
        Some((0..open).map(|t| all.fixed_view::<3, 3>(3 * t, 3 * t).into()).collect())
    }

    /// Covariance of the rows `kept` of the state with the rows `out` marginalised out: the inverse of the Schur complement.
    fn marginalize(&self, kept: core::ops::Range<usize>, out: core::ops::Range<usize>) -> Option<DMatrix<f64>> {
        let block = |rows: &core::ops::Range<usize>, columns: &core::ops::Range<usize>| {
            self.information.view_range(rows.clone(), columns.clone())
        };
        let eliminated = factor(block(&out, &out))?.solve(&block(&out, &kept));
        inverse((block(&kept, &kept) - block(&kept, &out) * eliminated).as_view())
    }

    fn pose(&self, t: usize) -> usize {
        assert!((1..=self.poses).contains(&t), "there is no pose {t}");
        3 * (t - 1)
    }

    fn landmark(&self, j: usize) -> usize {
        assert!(j < self.landmarks, "there is no landmark {j}");
        3 * self.poses + 2 * j
    }

    fn add<const R: usize, const C: usize>(
        &mut self,
        row: usize,
        column: usize,
        block: &fastslam::nalgebra::SMatrix<f64, R, C>,
    ) {
        let mut view = self.information.fixed_view_mut::<R, C>(row, column);
        view += block;
    }
}

/// Λ = L Lᵀ; `None` where it is not positive definite.
fn factor(information: DMatrixView<f64>) -> Option<Cholesky<f64, Dyn>> {
    Cholesky::new(information.into_owned())
}

/// Λ⁻¹, symmetric to the last bit.
fn inverse(information: DMatrixView<f64>) -> Option<DMatrix<f64>> {
    let inverse = factor(information)?.inverse();
    Some((&inverse + inverse.transpose()) * 0.5)
}

/// A covariance of N landmarks, (x, y) each \[m²\].
#[derive(Clone, PartialEq, Debug)]
pub struct MapCovariance(DMatrix<f64>);

impl MapCovariance {
    /// N.
    pub fn landmarks(&self) -> usize {
        self.0.nrows() / 2
    }

    /// All of it, 2 N × 2 N.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.0
    }

    /// Covariance of landmark `i` with landmark `j`, both from 0.
    pub fn block(&self, i: usize, j: usize) -> Matrix2<f64> {
        self.0.fixed_view::<2, 2>(2 * i, 2 * j).into()
    }

    /// ρ of two coordinates, each 2 j for the x of landmark j and 2 j + 1 for its y: Σ_ij / √(Σ_ii Σ_jj), from −1 to 1.
    pub fn correlation(&self, i: usize, j: usize) -> f64 {
        (self.0[(i, j)] / (self.0[(i, i)] * self.0[(j, j)]).sqrt()).clamp(-1.0, 1.0)
    }

    /// |ρ_ij| of two landmarks, from 0 to 1: their largest canonical correlation, which is the largest that any direction of one has
    /// with any direction of the other.
    ///
    /// The larger singular value of L_i⁻¹ Σ_ij L_j⁻ᵀ with Σ_ii = L_i L_iᵀ. It does not depend on how the axes lie, is never less
    /// than an entry of the block, and is 0 exactly where the block is.
    ///
    /// Reference: Hotelling, *Relations between two sets of variates*, Biometrika 28 (1936).
    pub fn coupling(&self, i: usize, j: usize) -> f64 {
        let whitened = whiten(&self.block(j, j), &whiten(&self.block(i, i), &self.block(i, j)).transpose());
        let squared = whitened * whitened.transpose();
        let (half_sum, half_difference) = (0.5 * (squared.m11 + squared.m22), 0.5 * (squared.m11 - squared.m22));
        let largest = half_sum + (half_difference * half_difference + squared.m12 * squared.m12).sqrt();
        largest.sqrt().min(1.0)
    }

    /// How many entries outside the 2 × 2 blocks of the diagonal are not 0.
    pub fn off_block_nonzeros(&self) -> usize {
        let size = self.0.nrows();
        let entries = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
        entries.filter(|&(i, j)| i / 2 != j / 2 && self.0[(i, j)] != 0.0).count()
    }
}

/// L⁻¹ B with Σ = L Lᵀ.
fn whiten(covariance: &Matrix2<f64>, b: &Matrix2<f64>) -> Matrix2<f64> {
    let l11 = covariance.m11.sqrt();
    let l21 = covariance.m21 / l11;
    let l22 = (covariance.m22 - l21 * l21).sqrt();
    let top = b.row(0) / l11;
    let bottom = (b.row(1) - top * l21) / l22;
    Matrix2::from_rows(&[top, bottom])
}

#[cfg(test)]
mod tests;
