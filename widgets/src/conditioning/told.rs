//! What is told of the map, in numbers and in words, by what is known of the path.

use super::recipe::Given;
use super::{challenges, model::ConditioningModel};
use crate::challenge::Challenge;
use crate::decimal::fixed;
use crate::model::{Column, Readout, Series, Tells};
use crate::words::{common, conditioning};
use fastslam_lab::{baseline::information_matrix::MapCovariance, experiment::conditioning::Covariances};

/// Two decimals; an exact 0 without any.
fn signed(rho: f64) -> String {
    if rho == 0.0 { "0".into() } else { fixed(rho, 2) }
}

/// Name of a row or a column: `m3.x`.
fn coordinate(k: usize) -> String {
    format!("m{}.{}", k / 2 + 1, ["x", "y"][k % 2])
}

/// What the landmarks have to do with each other, in numbers.
struct Couplings {
    /// Largest |ρ| of two landmarks; not a number for fewer than two.
    largest: f64,
    /// Mean |ρ| of all pairs; not a number for fewer than two.
    mean: f64,
    /// Standard deviation \[m\] of the least known direction of the least known landmark; not a number for none.
    largest_std: f64,
}

fn couplings(map: &MapCovariance) -> Couplings {
    let n = map.landmarks();
    let pairs: Vec<f64> = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| map.coupling(i, j)).collect();
    let block = |j| {
        let b = map.block(j, j);
        let (half_sum, half_difference) = (0.5 * (b.m11 + b.m22), 0.5 * (b.m11 - b.m22));
        (half_sum + (half_difference * half_difference + b.m12 * b.m12).sqrt()).sqrt()
    };
    Couplings {
        largest: pairs.iter().copied().fold(f64::NAN, f64::max),
        mean: if pairs.is_empty() { f64::NAN } else { pairs.iter().sum::<f64>() / pairs.len() as f64 },
        largest_std: (0..n).map(block).fold(f64::NAN, f64::max),
    }
}

impl Tells for ConditioningModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let Couplings { largest, mean, largest_std } = couplings(self.map());
        let count = |name, title, n: usize, of: usize, help| {
            Readout::new(name, title, n as f64, common::Of { n: &n, all: &of }.say(), "", help)
        };
        let entries = |name, title, n: usize, help| {
            Readout::new(name, title, n as f64, n.to_string(), conditioning::entries(), help)
        };
        let rho = self.correlation().unwrap_or(f64::NAN);
        vec![
            count("step", conditioning::driven(), self.recipe.step, self.setup().poses, conditioning::driven_help()),
            count(
                "seen",
                conditioning::seen(),
                self.covariances.seen.len(),
                self.setup().landmarks,
                conditioning::seen_help(),
            ),
            Readout::new("rho", conditioning::rho(), rho, signed(rho), "", conditioning::rho_help()),
            Readout::new(
                "largest",
                conditioning::largest(),
                largest,
                signed(largest),
                "",
                conditioning::largest_help(),
            ),
            Readout::new("mean", conditioning::mean(), mean, signed(mean), "", conditioning::mean_help()),
            count(
                "off_block",
                conditioning::off_block(),
                self.map().off_block_nonzeros(),
                self.off_block(),
                conditioning::off_block_help(),
            ),
            Readout::new(
                "largest_std",
                conditioning::least_known(),
                largest_std,
                fixed(largest_std, 3),
                "m",
                conditioning::least_known_help(),
            ),
            entries("ekf", conditioning::ekf(), self.ekf_entries(), conditioning::ekf_help()),
            entries("fastslam", conditioning::fastslam(), 4, conditioning::fastslam_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("step", "poses driven"),
            Column::new("seen", "landmarks seen"),
            Column::new("largest", "largest |ρ| of two landmarks with the path marginalised out"),
            Column::new("mean", "mean |ρ| of all pairs with the path marginalised out"),
            Column::new("off_block", "entries outside the blocks that are not 0 with the path marginalised out"),
            Column::new(
                "largest_std_m",
                "standard deviation of the least known landmark with the path marginalised out [m]",
            ),
            Column::new("off_block_given_path", "entries outside the blocks that are not 0 given the path"),
            Column::new(
                "largest_std_given_path_m",
                "standard deviation of the least known landmark given the path [m]",
            ),
        ];
        let row = |step: usize| {
            let Covariances { seen, marginal, conditional, .. } = self.drive.after(step);
            let (free, given) = (couplings(&marginal), couplings(&conditional));
            vec![
                step as f64,
                seen.len() as f64,
                free.largest,
                free.mean,
                marginal.off_block_nonzeros() as f64,
                free.largest_std,
                conditional.off_block_nonzeros() as f64,
                given.largest_std,
            ]
        };
        Series { columns: COLUMNS.into(), rows: (0..=self.recipe.step).map(row).collect() }
    }

    fn describe(&self) -> String {
        if self.recipe.step == 0 {
            return conditioning::at_start().into();
        }
        let (n, poses, seen) = (&self.recipe.step, &self.setup().poses, &self.covariances.seen.len());
        let (off, all, entry) = (&self.map().off_block_nonzeros(), &self.off_block(), &self.entry_and_why());
        match self.given() {
            Given::Nothing => conditioning::PathUnknown { n, poses, seen, off, all, entry }.say(),
            Given::LastPose => conditioning::LastKnown { n, poses, seen, off, all, entry }.say(),
            Given::Path if *off > 0 => conditioning::PairsCoupled { n, poses, seen, off, all, entry }.say(),
            Given::Path if self.is_sure() => conditioning::PathSure { n, poses, seen, off, all, entry }.say(),
            Given::Path => conditioning::PathKnown { n, poses, seen, off, all, entry }.say(),
        }
    }

    fn narrate(&self) -> String {
        if self.recipe.step == 0 {
            return conditioning::at_start().into();
        }
        let (off, all) = (&self.map().off_block_nonzeros(), &self.off_block());
        match self.given() {
            Given::Nothing => conditioning::NUnknown { off, all }.say(),
            Given::LastPose => conditioning::NLast { off, all }.say(),
            Given::Path if *off > 0 => conditioning::NPairs { off, all }.say(),
            Given::Path if self.is_sure() => conditioning::NSure { off, all }.say(),
            Given::Path => conditioning::NKnown { off, all }.say(),
        }
    }
}

impl ConditioningModel {
    /// The entry in words: `m1.y and m4.y: ρ = 0.62`.
    pub fn entry_text(&self) -> String {
        let [a, b] = self.recipe.entry.map(coordinate);
        match self.correlation() {
            Some(rho) => conditioning::Entry { a: &a, b: &b, rho: &signed(rho) }.say(),
            None => conditioning::EntryUnseen { a: &a, b: &b }.say(),
        }
    }

    /// The entry in words, and what its landmarks have to do with each other.
    fn entry_and_why(&self) -> String {
        let [a, b] = self.recipe.entry.map(|k| k / 2);
        let coupled = a != b && self.correlation().is_some_and(|rho| rho != 0.0) && self.given() == Given::Nothing;
        let entry = self.entry_text();
        match self.seen_together(a, b) {
            0 if coupled => conditioning::EntryApart { entry: &entry }.say(),
            _ if coupled => conditioning::EntryTogether { entry: &entry }.say(),
            _ => entry,
        }
    }
}
