//! What both methods assume: a corridor of cells, wheels that err, and a sensor that says *door* or does not.

use core::ops::Range;
use fastslam::error::{self, SettingError};
use fastslam::ops;

/// A corridor of cells, and what is known beforehand of how often the sensor says *door* in each.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Corridor {
    /// Number of cells, 1 to 1000.
    pub cells: u32,
    /// Length of a cell \[m\], 0.01 to 10.
    pub cell_size: f64,
    /// What is known of every cell before.
    pub known: Beta,
}

impl Corridor {
    /// Whether it can be computed with.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        error::Range::whole(1, 1000).check("cells", f64::from(self.cells))?;
        error::Range::number(0.01, 10.0, "m").check("cell_size", self.cell_size)?;
        self.known.validate()
    }

    /// The middle of a cell \[m\].
    pub fn place(&self, cell: usize) -> f64 {
        self.cell_size * (cell as f64 + 0.5)
    }

    /// The cell of a place \[m\], or the one at the nearer end.
    pub fn cell(&self, place: f64) -> usize {
        // A cast takes what is below the first cell for the first.
        ((place / self.cell_size) as usize).min(self.cells as usize - 1)
    }
}

/// Beta(a, b): a density over how often the sensor says *door* in a cell. As if it had said so a − 1 times, and b − 1 times not.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Beta {
    /// a, more than 1 and at most 1000.
    pub yes: f64,
    /// b, more than 1 and at most 1000.
    pub no: f64,
}

impl Beta {
    fn validate(&self) -> Result<(), SettingError> {
        // At 1 the density's peak may be at an end, where a single reading to the contrary is impossible.
        let range = error::Range::number(1.001, 1000.0, "");
        range.check("known.yes", self.yes)?;
        range.check("known.no", self.no).map(drop)
    }

    /// What comes of it when the sensor has said *door* so often, and so often not: Beta(a + yes, b + no).
    pub fn after(self, yes: f64, no: f64) -> Self {
        Self { yes: self.yes + yes, no: self.no + no }
    }

    /// How probably the next reading says *door*: a / (a + b).
    pub fn mean(self) -> f64 {
        self.yes / (self.yes + self.no)
    }

    /// Where the density is highest: (a − 1) / (a + b − 2).
    pub fn mode(self) -> f64 {
        (self.yes - 1.0) / (self.yes + self.no - 2.0)
    }

    /// Log of the density at `p` but for a constant \[nats\]: (a − 1) ln p + (b − 1) ln (1 − p).
    pub fn log_density(self, p: f64) -> f64 {
        (self.yes - 1.0) * ops::ln(p) + (self.no - 1.0) * ops::ln(1.0 - p)
    }
}

/// What the wheels report of a step: so far along the corridor, give or take so much \[m\].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shift {
    /// \[m\]
    pub by: f64,
    /// Its standard deviation \[m\].
    pub std: f64,
}

/// Standard deviations that a step's distribution reaches on either side.
const REACH: f64 = 4.0;

/// Where a step leads, cell by cell: p(x_t = x_{t−1} + k | u_t) for k from `first` on, the Gaussian's mass over the cell that is k cells
/// away. What would lead beyond an end of the corridor leads to the cell there: the robot stops at the wall.
#[derive(Clone, PartialEq, Debug)]
pub struct Kernel {
    cells: usize,
    first: i64,
    masses: Vec<f64>,
    /// Of the cells from which a step may meet a wall, in order: the first cell that it may lead to, and the probabilities from that one on.
    at_walls: Vec<(usize, Vec<f64>)>,
}

impl Kernel {
    /// Of a step in a corridor.
    ///
    /// # Errors
    /// Where the step is not finite, or its standard deviation is not one.
    pub fn new(corridor: &Corridor, shift: &Shift) -> Result<Self, SettingError> {
        error::Range::number(-1000.0, 1000.0, "m").check("by", shift.by)?;
        error::Range::number(0.0, 1000.0, "m").check("std", shift.std)?;
        let [by, std] = [shift.by, shift.std].map(|length| length / corridor.cell_size);
        // Further than from end to end nothing leads.
        let most = i64::from(corridor.cells);
        let [first, last] = [-1.0, 1.0].map(|side| ((by + side * REACH * std).round() as i64).clamp(-most, most));
        let below = |edge: f64| {
            let deviations = (edge - by) / std;
            // Without noise all is in one cell: the edge is on one side or the other.
            if std > 0.0 { 0.5 + 0.5 * ops::erf(deviations / core::f64::consts::SQRT_2) } else { f64::from(edge > by) }
        };
        let masses: Vec<f64> = (first..=last).map(|k| below(k as f64 + 0.5) - below(k as f64 - 0.5)).collect();
        let total: f64 = masses.iter().sum();
        let masses = if total > 0.0 { masses.iter().map(|mass| mass / total).collect() } else { vec![1.0] };
        let mut kernel = Self { cells: corridor.cells as usize, first, masses, at_walls: Vec::new() };
        let free = kernel.free();
        let from = |cell: usize| (kernel.leads(cell).start, kernel.from(cell).map(|(_, mass)| mass).collect());
        kernel.at_walls = (0..free.start).chain(free.end..kernel.cells).map(from).collect();
        Ok(kernel)
    }

    /// Cells that a step from a cell may lead to.
    fn leads(&self, cell: usize) -> Range<usize> {
        let last = self.cells as i64 - 1;
        let [first, end] = [0, self.masses.len() as i64 - 1].map(|k| (cell as i64 + self.first + k).clamp(0, last));
        first as usize..end as usize + 1
    }

    /// Cells that a step from a cell may lead to, with their probabilities.
    pub fn from(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let last = self.cells as i64 - 1;
        // The cell that lies so many masses from the first, were there no walls.
        let first = cell as i64 + self.first;
        let end = first + self.masses.len() as i64 - 1;
        let sum = |masses: Range<i64>| -> f64 { self.masses[masses.start as usize..masses.end as usize].iter().sum() };
        self.leads(cell).map(move |cell| {
            let to = cell as i64;
            // At a wall, with all that would lead beyond it.
            let from = if to == 0 { 0 } else { (to - first).max(0) };
            let until = if to == last { end } else { to.min(end) } - first;
            (cell, sum(from..until + 1))
        })
    }

    /// p(x_t | x_{t−1} = from, u_t).
    pub fn probability(&self, from: usize, to: usize) -> f64 {
        self.from(from).find(|(cell, _)| *cell == to).map_or(0.0, |(_, mass)| mass)
    }

    /// Where the step leads to for a number that is uniform on \[0, 1).
    pub fn draw(&self, from: usize, uniform: f64) -> usize {
        let mut left = uniform;
        let found = self.from(from).find(|(_, mass)| {
            left -= mass;
            left < 0.0
        });
        found.or_else(|| self.from(from).last()).map_or(from, |(cell, _)| cell)
    }

    /// Adds Σᵢ p(x_t = j | x_{t−1} = i) before(i) to every j, summed in the order of i.
    pub fn push(&self, before: &[f64], after: &mut [f64]) {
        let free = self.free();
        let (near, far) = self.at_walls.split_at(free.start);
        let push = |walls: &[(usize, Vec<f64>)], before: &[f64], after: &mut [f64]| {
            for ((to, masses), p) in walls.iter().zip(before) {
                after[*to..].iter_mut().zip(masses).for_each(|(after, mass)| *after += p * mass);
            }
        };
        push(near, before, after);
        for (to, mass) in self.shifted(&free).rev() {
            for (after, p) in after[to].iter_mut().zip(&before[free.clone()]) {
                *after += p * mass;
            }
        }
        push(far, &before[free.end..], after);
    }

    /// Adds Σⱼ p(x_t = j | x_{t−1} = i) after(j) to every i, summed in the order of j.
    pub fn pull(&self, after: &[f64], before: &mut [f64]) {
        let free = self.free();
        for (to, mass) in self.shifted(&free) {
            for (before, p) in before[free.clone()].iter_mut().zip(&after[to]) {
                *before += mass * p;
            }
        }
        for (cell, (to, masses)) in (0..free.start).chain(free.end..self.cells).zip(&self.at_walls) {
            before[cell] += masses.iter().zip(&after[*to..]).fold(0.0, |sum, (mass, p)| sum + mass * p);
        }
    }

    /// Cells from which no step meets a wall: from all of them it leads as far, with the same masses.
    fn free(&self) -> Range<usize> {
        let (cells, reach) = (self.cells as i64, self.first + self.masses.len() as i64 - 1);
        let start = (-self.first).clamp(0, cells);
        let end = (cells - reach).clamp(start, cells);
        start as usize..end as usize
    }

    /// Where the steps from these cells lead to: for each mass, from the first on, cells as many.
    fn shifted(&self, free: &Range<usize>) -> impl DoubleEndedIterator<Item = (Range<usize>, f64)> {
        let to = |cell: usize, k: usize| (cell as i64 + self.first) as usize + k;
        let (start, end) = (free.start, free.end);
        // From no cells nothing leads anywhere.
        let masses = if free.is_empty() { &[][..] } else { &self.masses[..] };
        masses.iter().enumerate().map(move |(k, mass)| (to(start, k)..to(end, k), *mass))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORRIDOR: Corridor = Corridor { cells: 20, cell_size: 0.2, known: Beta { yes: 1.2, no: 1.8 } };

    fn kernel(by: f64, std: f64) -> Kernel {
        Kernel::new(&CORRIDOR, &Shift { by, std }).unwrap()
    }

    #[test]
    fn from_every_cell_a_step_leads_somewhere() {
        for kernel in [kernel(0.2, 0.1), kernel(-9.0, 0.0), kernel(0.1, 0.0), kernel(1.0, 900.0), kernel(7.0, 0.3)] {
            for from in 0..20 {
                let all: f64 = (0..20).map(|to| kernel.probability(from, to)).sum();
                assert!((all - 1.0).abs() < 1e-12, "{from}: {all}");
            }
        }
        assert_eq!(kernel(-9.0, 0.0).probability(5, 0), 1.0, "the robot stops at the wall");
        assert_eq!(kernel(0.4, 0.0).probability(5, 7), 1.0);
    }

    #[test]
    fn pushing_and_pulling_are_each_others_transpose() {
        let (kernel, a) = (kernel(0.3, 0.15), |k: u32| f64::from(k * k % 7));
        let [before, after]: [Vec<f64>; 2] = [(0..20).map(a).collect(), (0..20).map(|k| a(k + 3)).collect()];
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let [mut pushed, mut pulled] = [vec![0.0; 20], vec![0.0; 20]];
        kernel.push(&before, &mut pushed);
        kernel.pull(&after, &mut pulled);
        let [one, other] = [dot(&pushed, &after), dot(&before, &pulled)];
        assert!((one - other).abs() < 1e-12 * one, "{one} {other}");
    }

    /// Bit for bit what the sums over all cells are, however near the walls are.
    #[test]
    fn cells_far_from_walls_are_summed_as_all_others() {
        for cells in [1, 2, 3, 20] {
            let corridor = Corridor { cells, ..CORRIDOR };
            let before: Vec<f64> = (0..cells).map(|k| f64::from(k * k % 7 + 1) / 3.0).collect();
            for by in [-9.0, -3.0, -0.4, 0.0, 0.1, 0.2, 1.0, 3.7, 7.0] {
                for std in [0.0, 0.1, 0.3, 0.9, 900.0] {
                    let kernel = Kernel::new(&corridor, &Shift { by, std }).unwrap();
                    let [mut pushed, mut pulled, mut forward, mut backward] = [(); 4].map(|()| vec![0.0; before.len()]);
                    for from in 0..before.len() {
                        for (to, mass) in kernel.from(from) {
                            pushed[to] += before[from] * mass;
                            pulled[from] += mass * before[to];
                        }
                    }
                    kernel.push(&before, &mut forward);
                    kernel.pull(&before, &mut backward);
                    assert_eq!((forward, backward), (pushed, pulled), "{cells}: {by} {std}");
                }
            }
        }
    }

    #[test]
    fn a_draw_goes_through_the_cells_as_their_masses_do() {
        let kernel = kernel(0.2, 0.12);
        let n = 10_000;
        let draws: Vec<usize> = (0..n).map(|k| kernel.draw(9, (f64::from(k) + 0.5) / f64::from(n))).collect();
        for cell in 0..20 {
            let share = draws.iter().filter(|drawn| **drawn == cell).count() as f64 / f64::from(n);
            assert!((share - kernel.probability(9, cell)).abs() < 2.0 / f64::from(n), "{cell}");
        }
    }

    #[test]
    fn what_is_known_moves_with_what_is_counted() {
        let beta = Beta { yes: 1.5, no: 2.5 }.after(3.0, 1.0);
        assert_eq!((beta.mean(), beta.mode()), (4.5 / 8.0, 3.5 / 6.0));
        let at = |p| beta.log_density(p);
        assert!(at(beta.mode()) > at(beta.mode() - 0.01) && at(beta.mode()) > at(beta.mode() + 0.01));
    }

    #[test]
    fn a_setting_out_of_range_is_refused_by_name() {
        let refused = |corridor: Corridor| corridor.validate().unwrap_err().field();
        assert_eq!(refused(Corridor { cells: 0, ..CORRIDOR }), "cells");
        assert_eq!(refused(Corridor { cell_size: f64::NAN, ..CORRIDOR }), "cell_size");
        assert_eq!(refused(Corridor { known: Beta { yes: 1.0, no: 2.0 }, ..CORRIDOR }), "known.yes");
        assert_eq!(Kernel::new(&CORRIDOR, &Shift { by: 0.0, std: -1.0 }).unwrap_err().field(), "std");
    }
}
