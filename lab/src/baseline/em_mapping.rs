//! EM mapping in one dimension: the path as a whole distribution, the map decided.
//!
//! A robot rides along a [`Corridor`] of cells. At step t its wheels report u_t, and its sensor says *door* or does not, z_t ∈ {1, 0}. The
//! path x₀, x₁, …, x_T is a hidden Markov chain with p(x_t | x_{t−1}, u_t) of a [`Kernel`], and x₀ is known. The map is a number per cell,
//! m_c = p(z = 1 | x = c), of which a [`Beta`] is known beforehand. Doors have no names: nothing says which of them a reading came from.
//!
//! From a first map m⁽⁰⁾ on, each iteration does two things.
//!
//! **E**, localisation with the map m⁽ⁱ⁾ taken for true, in both directions:
//!
//! - α_t(c) = p(x_t = c, z₁..ₜ) = p(z_t | c, m) Σ_b p(c | b, u_t) α_{t−1}(b), the forward pass;
//! - β_t(c) = p(z_{t+1..T} | x_t = c) = Σ_d p(d | c, u_{t+1}) p(z_{t+1} | d, m) β_{t+1}(d), the backward pass, from β_T = 1;
//! - γ_t(c) = p(x_t = c | z₁..T) = α_t(c) β_t(c) / p(z₁..T), their product. Σ_c α_t(c) β_t(c) = p(z₁..T) is the same at every t.
//!
//! Columns are kept with a sum of 1, and the logs of what they were divided by apart, so that nothing underflows (Rabiner 1989, section V.A).
//!
//! **M**, the map that makes the readings most probable, each counted wherever it may have been taken, in proportion:
//! m_c⁽ⁱ⁺¹⁾ = (a − 1 + Σ_t γ_t(c) z_t) / (a + b − 2 + Σ_t γ_t(c)), where Beta(a, b) is what is known: the peak of the expected log
//! posterior. In a cell where nobody was it is the peak of the Beta.
//!
//! ln p(z₁..T | m) + ln p(m) never falls from one iteration to the next (Dempster, Laird, Rubin 1977, theorem 1). Where it ends depends on
//! the first map: it is a local maximum.
//!
//! Units: places in m, logs in nats. Shapes: T + 1 columns of as many numbers as there are cells; a pass takes T · cells · (width of the
//! kernel) multiplications.
//!
//! Of the two unknowns the particles of [`DoorCounts`] and [`ByWheels`] do the opposite, in the same world: they sample the path, and
//! compute the map.
//!
//! S. Thrun, W. Burgard, D. Fox, *A Probabilistic Approach to Concurrent Mapping and Localization for Mobile Robots*, 1998, whose
//! algorithm this is; A. Dempster, N. Laird, D. Rubin 1977; L. Rabiner, *A Tutorial on Hidden Markov Models*, 1989.

mod corridor;
mod counts;
#[cfg(test)]
mod tests;

pub use corridor::{Beta, Corridor, Kernel, Shift};
pub use counts::{ByWheels, DoorCounts};

use fastslam::error::{Range, SettingError};
use fastslam::ops;

/// What a robot reported of a ride.
#[derive(Clone, PartialEq, Debug)]
pub struct Ride {
    corridor: Corridor,
    /// The cell of x₀.
    start: usize,
    /// Distinct steps; and of every step, which of them it is.
    kernels: Vec<Kernel>,
    steps: Vec<usize>,
    readings: Vec<bool>,
}

impl Ride {
    /// From a place that is known \[m\]: of each step what the wheels report, and what the sensor said where it led.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(corridor: Corridor, start: f64, log: &[(Shift, bool)]) -> Result<Self, SettingError> {
        corridor.validate()?;
        let length = corridor.cell_size * f64::from(corridor.cells);
        let start = corridor.cell(Range::number(0.0, length, "m").check("start", start)?);
        let (mut shifts, mut kernels, mut steps) = (Vec::new(), Vec::new(), Vec::new());
        for (shift, _) in log {
            let found = shifts.iter().position(|known| known == shift);
            if found.is_none() {
                kernels.push(Kernel::new(&corridor, shift)?);
                shifts.push(*shift);
            }
            steps.push(found.unwrap_or(kernels.len() - 1));
        }
        Ok(Self { corridor, start, kernels, steps, readings: log.iter().map(|(_, says)| *says).collect() })
    }

    /// Where it was ridden.
    pub fn corridor(&self) -> &Corridor {
        &self.corridor
    }

    /// The cell that it begins in.
    pub fn start(&self) -> usize {
        self.start
    }

    /// Number of the last step, T.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// Where a step leads, from 1 to T.
    pub fn kernel(&self, step: usize) -> &Kernel {
        &self.kernels[self.steps[step - 1]]
    }

    /// Whether the sensor said *door* after a step, from 1 to T.
    pub fn says_door(&self, step: usize) -> bool {
        self.readings[step - 1]
    }

    /// p(z_t | x_t = c, m) of every cell c.
    fn likelihood(&self, step: usize, map: &[f64]) -> impl Iterator<Item = f64> {
        let says = self.says_door(step);
        map.iter().map(move |door| if says { *door } else { 1.0 - door })
    }
}

/// Steps whose products are summed at once.
const SIDE_BY_SIDE: usize = 4;

/// A map: how probably the sensor says *door*, for each cell, between 0 and 1.
pub type DoorMap = Vec<f64>;

/// Columns of a pass in one array, each divided by its sum.
#[derive(Clone, PartialEq, Debug)]
struct Columns {
    cells: usize,
    values: Vec<f64>,
    /// Sum of each column before the division.
    sums: Vec<f64>,
}

impl Columns {
    fn new(cells: usize, count: usize) -> Self {
        Self { cells, values: Vec::with_capacity(cells * count), sums: Vec::with_capacity(count) }
    }

    fn clear(&mut self) {
        self.values.clear();
        self.sums.clear();
    }

    fn len(&self) -> usize {
        self.sums.len()
    }

    fn get(&self, index: usize) -> Option<&[f64]> {
        self.values.chunks_exact(self.cells).nth(index)
    }

    /// Log of all that the pass was divided by up to a column \[nats\].
    fn log_scale(&self, index: usize) -> Option<f64> {
        Some(self.sums.get(..=index)?.iter().fold(0.0, |log, sum| log + ops::ln(*sum)))
    }

    /// Appends a column of zeros, which `make` fills from the previous column, if there is one.
    fn push(&mut self, make: impl FnOnce(Option<&[f64]>, &mut [f64])) {
        let begin = self.values.len();
        self.values.resize(begin + self.cells, 0.0);
        let (before, column) = self.values.split_at_mut(begin);
        make(before.rchunks_exact(self.cells).next(), column);
        let sum: f64 = column.iter().sum();
        column.iter_mut().for_each(|p| *p /= sum);
        self.sums.push(sum);
    }
}

/// The E step, a column at a time: either pass can be stopped anywhere.
#[derive(Clone, PartialEq, Debug)]
pub struct Expectation {
    map: DoorMap,
    /// T.
    last: usize,
    /// α₀, α₁, … as far as they are computed.
    forward: Columns,
    /// β_T, β_{T−1}, … the same way.
    backward: Columns,
}

impl Expectation {
    /// Before the first column of either pass, with a map that is taken for true.
    ///
    /// # Errors
    /// Where the map has another number of cells, or where one says that a reading is impossible.
    pub fn new(map: DoorMap, ride: &Ride) -> Result<Self, SettingError> {
        let cells = ride.corridor.cells as usize;
        if map.len() != cells || map.iter().any(|door| !(*door > 0.0 && *door < 1.0)) {
            return Err(SettingError::Unfit { field: "map", allowed: "a number between 0 and 1 for each cell" });
        }
        let [forward, backward] = [(); 2].map(|()| Columns::new(cells, ride.steps() + 1));
        Ok(Self { map, last: ride.steps(), forward, backward })
    }

    /// The next column of the forward pass, while there is one: move, then see.
    pub fn advance(&mut self, ride: &Ride) {
        let (step, map) = (self.forward.len(), &self.map);
        if step > self.last {
            return;
        }
        self.forward.push(|before, column| match before {
            None => column[ride.start] = 1.0,
            Some(before) => {
                ride.kernel(step).push(before, column);
                column.iter_mut().zip(ride.likelihood(step, map)).for_each(|(p, seen)| *p *= seen);
            }
        });
    }

    /// The next column of the backward pass, while there is one, from the last step down: the same the other way round.
    pub fn retreat(&mut self, ride: &Ride) {
        self.retreat_by(ride, &mut Vec::new());
    }

    fn retreat_by(&mut self, ride: &Ride, seen: &mut Vec<f64>) {
        let (done, map) = (self.backward.len(), &self.map);
        if done > self.last {
            return;
        }
        let step = self.last + 1 - done;
        self.backward.push(|after, column| match after {
            None => column.fill(1.0),
            Some(after) => pull(ride, step, map, after, seen, column),
        });
    }

    /// Both passes from end to end.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of(map: DoorMap, ride: &Ride) -> Result<Self, SettingError> {
        let mut whole = Self::new(map, ride)?;
        whole.run(ride);
        Ok(whole)
    }

    fn run(&mut self, ride: &Ride) {
        let mut seen = Vec::with_capacity(self.map.len());
        for _ in 0..=self.last {
            self.advance(ride);
            self.retreat_by(ride, &mut seen);
        }
    }

    /// One iteration: the M step, and both passes with the new map. `None` where a pass is not complete.
    pub fn iterate(&mut self, ride: &Ride) -> Option<()> {
        self.map = self.maximise(ride)?;
        self.forward.clear();
        self.backward.clear();
        self.run(ride);
        Some(())
    }

    /// The map that is taken for true.
    pub fn map(&self) -> &DoorMap {
        &self.map
    }

    /// α_t over its sum: where the robot was, by all readings up to then. `None` where the pass has not been yet.
    pub fn forward(&self, step: usize) -> Option<&[f64]> {
        self.forward.get(step)
    }

    /// β_t over its sum: how well a cell explains all readings after. `None` where the pass has not been yet.
    pub fn backward(&self, step: usize) -> Option<&[f64]> {
        self.backward.get(self.last.checked_sub(step)?)
    }

    /// γ_t: where the robot was, by all readings. `None` where not both passes have been.
    pub fn product(&self, step: usize) -> Option<Vec<f64>> {
        Some(shares(self.forward(step)?, self.backward(step)?))
    }

    /// p(x_t | z₁..z_{t+lag}, m), the fixed-lag smoother: where the robot was, by all readings up to then and so many after. With none it is
    /// the forward pass, with all of them γ_t. It takes `lag` columns of a backward pass that begins there; of the backward pass that is kept it
    /// needs none. `None` where the forward pass has not been yet.
    pub fn smoothed(&self, ride: &Ride, step: usize, lag: usize) -> Option<Vec<f64>> {
        let (mut backward, mut seen) = (Columns::new(self.map.len(), lag + 1), Vec::new());
        backward.push(|_, column| column.fill(1.0));
        for later in (step + 1..=(step + lag).min(self.last)).rev() {
            backward.push(|after, column| {
                after.into_iter().for_each(|after| pull(ride, later, &self.map, after, &mut seen, column));
            });
        }
        Some(shares(self.forward(step)?, backward.get(backward.len() - 1)?))
    }

    /// ln p(z₁..T | m) \[nats\]. `None` where the forward pass is not through.
    pub fn log_likelihood(&self) -> Option<f64> {
        self.forward.log_scale(self.last)
    }

    /// The same by the columns of one step: ln Σ_c α_t(c) β_t(c). It does not depend on the step.
    pub fn log_likelihood_at(&self, step: usize) -> Option<f64> {
        let sum: f64 = self.forward(step)?.iter().zip(self.backward(step)?).map(|(a, b)| a * b).sum();
        Some(ops::ln(sum) + self.forward.log_scale(step)? + self.backward.log_scale(self.last - step)?)
    }

    /// Entropy of the whole path, given the readings and the map \[nats\]. `None` where a pass is not through.
    ///
    /// Backwards in time a path is a chain too, with p(x_{t−1} | x_t, z₁..T) ∝ p(x_t | x_{t−1}) α_{t−1}(x_{t−1}). So its entropy is that of γ_T,
    /// and of each of these by γ_t (Hernando, Crespi, Cybenko 2005).
    pub fn path_entropy(&self, ride: &Ride) -> Option<f64> {
        let mut entropy: f64 = self.product(self.last)?.iter().map(|p| -log_share(*p)).sum();
        for step in 1..=self.last {
            let (before, now) = (self.forward(step - 1)?, self.product(step)?);
            // Of the cells that lead to each: Σ p, and Σ p ln p.
            let mut sums = vec![[0.0; 2]; before.len()];
            for (cell, p) in before.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                for (to, mass) in ride.kernel(step).from(cell) {
                    sums[to][0] += p * mass;
                    sums[to][1] += log_share(p * mass);
                }
            }
            let of = |[sum, logs]: &[f64; 2]| if *sum > 0.0 { ops::ln(*sum) - logs / sum } else { 0.0 };
            entropy += sums.iter().zip(&now).filter(|(_, p)| **p > 0.0).map(|(sums, p)| p * of(sums)).sum::<f64>();
        }
        Some(entropy)
    }

    /// The M step: of every cell, how often the sensor said *door* there, of all times that the robot was there. Nobody knows when it was;
    /// so each reading counts at every cell, by the probability that it was taken there.
    ///
    /// `None` where a pass is not through.
    pub fn maximise(&self, ride: &Ride) -> Option<DoorMap> {
        let through = self.forward.len().min(self.backward.len()) > self.last;
        let (cells, last) = (through.then_some(self.map.len())?, self.last);
        let mut counts = vec![[0.0; 2]; cells];
        // α₁, … and β₁, …, four steps at a time: their sums do not wait for each other.
        let (forward, backward) = (&self.forward.values[cells..], &self.backward.values[..cells * last]);
        for (first, forward) in (1..).step_by(SIDE_BY_SIDE).zip(forward.chunks(cells * SIDE_BY_SIDE)) {
            let count = forward.len() / cells;
            let alphas: [&[f64]; SIDE_BY_SIDE] =
                core::array::from_fn(|k| &forward[cells * k.min(count - 1)..][..cells]);
            let betas: [&[f64]; SIDE_BY_SIDE] =
                core::array::from_fn(|k| &backward[cells * (last - first - k.min(count - 1))..][..cells]);
            let mut sums = [0.0; SIDE_BY_SIDE];
            for cell in 0..cells {
                for (sum, (alpha, beta)) in sums.iter_mut().zip(alphas.iter().zip(&betas)) {
                    *sum += alpha[cell] * beta[cell];
                }
            }
            for (k, sum) in sums.into_iter().enumerate().take(count) {
                let missed = usize::from(!ride.says_door(first + k));
                for (count, (a, b)) in counts.iter_mut().zip(alphas[k].iter().zip(betas[k])) {
                    count[missed] += a * b / sum;
                }
            }
        }
        let known = ride.corridor.known;
        Some(counts.iter().map(|[yes, no]| known.after(*yes, *no).mode()).collect())
    }
}

/// The product of two columns over its sum.
fn shares(forward: &[f64], backward: &[f64]) -> Vec<f64> {
    let product: Vec<f64> = forward.iter().zip(backward).map(|(a, b)| a * b).collect();
    let sum: f64 = product.iter().sum();
    product.iter().map(|p| p / sum).collect()
}

/// The column of the backward pass before a step, from the one after it.
fn pull(ride: &Ride, step: usize, map: &[f64], after: &[f64], seen: &mut Vec<f64>, before: &mut [f64]) {
    seen.clear();
    seen.extend(after.iter().zip(ride.likelihood(step, map)).map(|(p, z)| p * z));
    ride.kernel(step).pull(seen, before);
}

/// p ln p, which is 0 at 0.
fn log_share(p: f64) -> f64 {
    if p > 0.0 { p * ops::ln(p) } else { 0.0 }
}

/// ln p(m) of a map, but for a constant \[nats\].
pub fn log_prior(map: &[f64], known: Beta) -> f64 {
    map.iter().map(|door| known.log_density(*door)).sum()
}
