//! A symmetric positive definite system of which each row is kept from its first entry on.
//!
//! A path whose poses are tied to their neighbours has a narrow band; an edge that closes a loop makes one row long, not the matrix
//! full. A Cholesky factor fills a row only from its first entry on, so that what is kept need not grow (Jennings 1966).

use core::ops::Range;

/// Rows that are factored side by side: those of a pose.
const ROWS: usize = 3;

/// The lower half of a symmetric matrix, and then its factor, row by row.
#[derive(Clone, Debug)]
pub(super) struct Envelope {
    /// The first column that each row keeps.
    first: Vec<usize>,
    /// Where each row begins among the values, and behind the last the end of all.
    start: Vec<usize>,
    values: Vec<f64>,
}

impl Envelope {
    /// Of zeros, where row k keeps the columns from `first[k]` to k.
    pub fn new(first: Vec<usize>) -> Self {
        let mut start = vec![0];
        for (row, column) in first.iter().enumerate() {
            start.push(start[row] + row + 1 - column);
        }
        let values = vec![0.0; start[first.len()]];
        Self { first, start, values }
    }

    pub fn size(&self) -> usize {
        self.first.len()
    }

    /// Adds to the entry of a row and a column; above the diagonal means below it.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let (row, column) = (row.max(column), row.min(column));
        self.values[self.start[row] + column - self.first[row]] += value;
    }

    /// An entry of the diagonal.
    pub fn diagonal(&mut self, row: usize) -> &mut f64 {
        &mut self.values[self.start[row + 1] - 1]
    }

    /// Columns of a row from `from` on and before `to`, which it keeps.
    fn row(&self, row: usize, columns: Range<usize>) -> &[f64] {
        let offset = self.start[row];
        &self.values[offset + columns.start - self.first[row]..offset + columns.end - self.first[row]]
    }

    /// Becomes the factor L of L Lᵀ; `None` where it is not positive definite.
    ///
    /// The rows of a pose begin at the same column, and none of them needs another one before their own columns: up to there they go side by
    /// side, so that none waits for the sums and divisions of the others.
    pub fn factor(mut self) -> Option<Factor> {
        let mut done = 0;
        while done < self.size() {
            let first = self.first[done];
            let alike = self.first[done..].iter().take(ROWS).take_while(|other| **other == first).count();
            let (rows, from) = if alike == ROWS { (ROWS, done) } else { (1, first) };
            (first..from).for_each(|column| self.eliminate::<ROWS>(done, column));
            for row in done..done + rows {
                (from..row).for_each(|column| self.eliminate::<1>(row, column));
                let [left] = self.left(row, row);
                if !(left > 0.0 && left.is_finite()) {
                    return None;
                }
                *self.diagonal(row) = left.sqrt();
            }
            done += rows;
        }
        Some(Factor(self))
    }

    /// The entries of a column in so many rows from this one on, which begin alike.
    fn eliminate<const N: usize>(&mut self, row: usize, column: usize) {
        let (left, pivot) = (self.left::<N>(row, column), *self.diagonal(column));
        for (k, left) in left.into_iter().enumerate() {
            let at = self.start[row + k] + column - self.first[row];
            self.values[at] = left / pivot;
        }
    }

    /// What is left of them when the columns before it are taken off.
    fn left<const N: usize>(&self, row: usize, column: usize) -> [f64; N] {
        let from = self.first[row].max(self.first[column]);
        let rows: [&[f64]; N] = core::array::from_fn(|k| self.row(row + k, from..column + 1));
        let sums = dots(rows, self.row(column, from..column));
        core::array::from_fn(|k| rows[k][column - from] - sums[k])
    }
}

/// Of each of the first with the last, in a fixed order on every platform, in four sums so that a compiler may do them at once.
fn dots<const N: usize>(a: [&[f64]; N], b: &[f64]) -> [f64; N] {
    let mut sums = [[0.0; 4]; N];
    let (fours, rest) = b.as_chunks::<4>();
    let a = a.map(|a| a[..b.len()].as_chunks::<4>());
    for (at, b) in fours.iter().enumerate() {
        for (sums, (a, _)) in sums.iter_mut().zip(&a) {
            for k in 0..4 {
                sums[k] += a[at][k] * b[k];
            }
        }
    }
    core::array::from_fn(|n| {
        let tail: f64 = a[n].1.iter().zip(rest).map(|(a, b)| a * b).sum();
        (sums[n][0] + sums[n][1]) + (sums[n][2] + sums[n][3]) + tail
    })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let [sum] = dots([a], b);
    sum
}

/// L of L Lᵀ.
pub(super) struct Factor(Envelope);

impl Factor {
    /// x of L Lᵀ x = b.
    pub fn solve(&self, mut b: Vec<f64>) -> Vec<f64> {
        let Self(l) = self;
        for row in 0..l.size() {
            let first = l.first[row];
            let sum = dot(l.row(row, first..row), &b[first..row]);
            b[row] = (b[row] - sum) / l.values[l.start[row + 1] - 1];
        }
        for row in (0..l.size()).rev() {
            b[row] /= l.values[l.start[row + 1] - 1];
            let (first, x) = (l.first[row], b[row]);
            for (value, b) in l.row(row, first..row).iter().zip(&mut b[first..row]) {
                *b -= value * x;
            }
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::nalgebra::{DMatrix, DVector};
    use fastslam::random::{Purpose, Stream};

    /// AᵀA of a random matrix with the shape of a graph's: a band, and long rows.
    fn random(seed: u64, size: usize) -> (Envelope, DMatrix<f64>) {
        let mut stream = Stream::at(seed, Purpose::TRIAL, 0, 0);
        let first: Vec<usize> =
            (0..size).map(|row| if row % 7 == 6 { row / 3 } else { row.saturating_sub(4) }).collect();
        let mut dense = DMatrix::<f64>::zeros(size, size);
        for (row, from) in first.iter().enumerate() {
            for column in *from..row {
                let value = stream.normal();
                (dense[(row, column)], dense[(column, row)]) = (value, value);
            }
        }
        for row in 0..size {
            // Larger than the others of its row together: positive definite (Gershgorin).
            dense[(row, row)] = 0.5 + dense.row(row).iter().map(|x| x.abs()).sum::<f64>();
        }
        let mut envelope = Envelope::new(first.clone());
        for row in 0..size {
            (first[row]..=row).for_each(|column| envelope.add(column, row, dense[(row, column)]));
        }
        (envelope, dense)
    }

    #[test]
    fn the_solution_is_that_of_a_dense_factor() {
        for seed in 0..20 {
            let size = 5 + 7 * seed as usize;
            let (envelope, dense) = random(seed, size);
            let b: Vec<f64> = (0..size).map(|k| (k % 5) as f64 - 2.0).collect();
            let expected = dense.cholesky().unwrap().solve(&DVector::from_vec(b.clone()));
            let found = DVector::from_vec(envelope.factor().unwrap().solve(b));
            // Both factors are backward stable: some n ε of the solution.
            assert!((found - &expected).norm() <= 1e-12 * expected.norm().max(1.0), "seed {seed}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_has_no_factor() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let (mut envelope, _) = random(1, 12);
            *envelope.diagonal(5) = value;
            assert!(envelope.factor().is_none(), "{value}");
        }
    }
}
