//! The graphical model as a deterministic state: a drive, how much of it was driven, and whether the path is known.

use super::{
    layout::{Layout, NARROWEST},
    params, scene,
};
use crate::decimal::{fixed, write};
use crate::{
    model::{Column, FigureError, Group, Model, ParamSpec, Readout, Series},
    param::{Value, flag_text, unknown},
    scene::{Point, Scene},
};
use fastslam_lab::{
    baseline::joint::MapCovariance,
    experiment::conditioning::{Conditioning, ConditioningSetup, Covariances},
};

/// Figure w17.4.
pub struct ConditioningModel {
    drive: Conditioning,
    /// How many poses have been driven.
    step: usize,
    /// What is known after them.
    covariances: Covariances,
    /// Whether the path counts as known.
    conditioned: bool,
    /// Row and column of the entry that is named, from 0 to 2 N − 1.
    entry: [usize; 2],
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

impl Default for ConditioningModel {
    fn default() -> Self {
        let setup = ConditioningSetup::default();
        let drive = Conditioning::new(&setup).unwrap_or_else(|error| unreachable!("the default setup: {error}"));
        let covariances = drive.after(setup.poses);
        Self { drive, step: setup.poses, covariances, conditioned: false, entry: params::ENTRY }
    }
}

impl ConditioningModel {
    /// Title for readers.
    pub const TITLE: &'static str = "What the path does to the map";

    /// The drive.
    pub fn drive(&self) -> &Conditioning {
        &self.drive
    }

    /// What is known after the poses driven.
    pub fn covariances(&self) -> &Covariances {
        &self.covariances
    }

    /// Whether the path counts as known.
    pub fn conditioned(&self) -> bool {
        self.conditioned
    }

    /// The covariance of the landmarks seen that is shown.
    pub fn map(&self) -> &MapCovariance {
        if self.conditioned { &self.covariances.conditional } else { &self.covariances.marginal }
    }

    /// Row and column of the entry that is named, from 0 to 2 N − 1.
    pub fn entry(&self) -> [usize; 2] {
        self.entry
    }

    /// ρ of the entry that is named; `None` where one of its landmarks was not seen yet.
    pub fn correlation(&self) -> Option<f64> {
        let [row, column] = self.entry.map(|k| self.place(k / 2).map(|j| 2 * j + k % 2));
        Some(self.map().correlation(row?, column?))
    }

    /// Where a landmark stands among those seen.
    pub fn place(&self, landmark: usize) -> Option<usize> {
        self.covariances.seen.iter().position(|&j| j == landmark)
    }

    /// From how many of the poses driven both landmarks were seen.
    pub fn seen_together(&self, a: usize, b: usize) -> usize {
        (1..=self.step).filter(|&t| [a, b].iter().all(|j| self.drive.sightings(t).contains(j))).count()
    }

    /// The entry in words: `m1.y and m4.y: ρ = 0.62`.
    pub fn entry_text(&self) -> String {
        let [a, b] = self.entry.map(coordinate);
        match self.correlation() {
            Some(rho) => format!("{a} and {b}: ρ = {}", signed(rho)),
            None => format!("{a} and {b}: not seen yet"),
        }
    }

    /// How many entries of its covariance an EKF changes at one sighting: all of (2 N + 3)².
    pub fn ekf_entries(&self) -> usize {
        let size = 2 * self.drive.landmarks().len() + 3;
        size * size
    }

    /// How many entries of a map of the landmarks seen lie outside the blocks.
    pub fn off_block(&self) -> usize {
        let n = self.covariances.seen.len();
        4 * n * n.saturating_sub(1)
    }

    fn setup(&self) -> &ConditioningSetup {
        self.drive.setup()
    }

    fn go(&mut self, step: usize) {
        let step = step.min(self.setup().poses);
        if step != self.step {
            self.step = step;
            self.covariances = self.drive.after(step);
        }
    }

    fn rebuild(&mut self, setup: &ConditioningSetup) -> Result<(), FigureError> {
        self.drive = Conditioning::new(setup)?;
        self.step = self.step.min(setup.poses);
        self.covariances = self.drive.after(self.step);
        self.choose(self.entry.map(|k| k as f64));
        Ok(())
    }

    /// The entry nearest to a row and a column.
    fn choose(&mut self, entry: [f64; 2]) {
        let last = (2 * self.setup().landmarks - 1) as f64;
        self.entry = entry.map(|k| k.max(0.0).min(last) as usize);
    }

    fn set_view(&mut self, name: &str, value: Value) {
        match (name, value) {
            ("condition", Value::Flag(on)) => self.conditioned = on,
            ("step", Value::Number(x)) => self.go(x as usize),
            ("row", Value::Number(x)) => self.entry[0] = x as usize - 1,
            ("column", Value::Number(x)) => self.entry[1] = x as usize - 1,
            _ => (),
        }
    }
}

/// Name of a row or a column: `m3.x`.
fn coordinate(k: usize) -> String {
    format!("m{}.{}", k / 2 + 1, ["x", "y"][k % 2])
}

/// Two decimals with a minus of its own length; an exact 0 without any.
fn signed(rho: f64) -> String {
    if rho == 0.0 { "0".into() } else { fixed(rho, 2).replace('-', "−") }
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

impl Model for ConditioningModel {
    fn title(&self) -> &'static str {
        Self::TITLE
    }

    fn params(&self) -> Vec<ParamSpec> {
        params::specs(self.setup())
    }

    fn value(&self, name: &str) -> Option<String> {
        let setup = self.setup();
        Some(match name {
            "odometry" => write(setup.odometry_scale),
            "range-std" => write(setup.range_std),
            "landmarks" => setup.landmarks.to_string(),
            "poses" => setup.poses.to_string(),
            "condition" => flag_text(self.conditioned),
            "step" => self.step.to_string(),
            "row" => (self.entry[0] + 1).to_string(),
            "column" => (self.entry[1] + 1).to_string(),
            _ => return None,
        })
    }

    fn configure(&mut self, values: &[(String, String)]) -> Vec<FigureError> {
        let mut refused = Vec::new();
        let mut setup = self.setup().clone();
        let specs = self.params();
        for (name, text) in values {
            match specs.iter().find(|s| s.name == name) {
                Some(spec) if spec.group == Group::Setup => match (name.as_str(), spec.check(text)) {
                    ("odometry", Ok(Value::Number(x))) => setup.odometry_scale = x,
                    ("range-std", Ok(Value::Number(x))) => setup.range_std = x,
                    ("landmarks", Ok(Value::Number(x))) => setup.landmarks = x as usize,
                    ("poses", Ok(Value::Number(x))) => setup.poses = x as usize,
                    (_, result) => refused.extend(result.err()),
                },
                Some(_) => (),
                None => refused.push(unknown(name, &specs)),
            }
        }
        if setup != *self.setup() {
            refused.extend(self.rebuild(&setup).err());
        }
        // After the setup, which decides how many steps and entries there are.
        let specs = self.params();
        for (name, text) in values {
            if let Some(spec) = specs.iter().find(|s| s.name == name && s.group == Group::View) {
                match spec.check(text) {
                    Ok(value) => self.set_view(name, value),
                    Err(error) => refused.push(error),
                }
            }
        }
        refused
    }

    fn seek(&mut self, step: u32) {
        self.go(step as usize);
    }

    fn drag(&mut self, handle: &str, to: Point, width: f64) {
        if handle == scene::ENTRY {
            let area = Layout::new(width).matrix;
            let cell = area.w / (2 * self.setup().landmarks) as f64;
            self.choose([(to[1] - area.y) / cell, (to[0] - area.x) / cell]);
        }
    }

    fn nudge(&mut self, handle: &str, [right, up]: [f64; 2]) {
        if handle == scene::ENTRY {
            // There is nothing between two entries: a fine step is a whole one too.
            let whole = |steps: f64| if steps == 0.0 { 0.0 } else { steps.signum() * steps.abs().max(1.0) };
            let [row, column] = self.entry.map(|k| k as f64);
            self.choose([row - whole(up), column + whole(right)]);
        }
    }

    fn step_count(&self) -> u32 {
        self.setup().poses as u32
    }

    fn step(&self) -> u32 {
        self.step as u32
    }

    fn readouts(&self) -> Vec<Readout> {
        let Couplings { largest, mean, largest_std } = couplings(self.map());
        let count = |name, title, n: usize, of: usize, help| {
            Readout::new(name, title, n as f64, format!("{n} of {of}"), "", help)
        };
        let entries = |name, title, n: usize, help| Readout::new(name, title, n as f64, n.to_string(), "entries", help);
        let rho = self.correlation().unwrap_or(f64::NAN);
        vec![
            count(
                "step",
                "Poses driven",
                self.step,
                self.setup().poses,
                "How many poses the graph has, besides the known start.",
            ),
            count(
                "seen",
                "Landmarks seen",
                self.covariances.seen.len(),
                self.setup().landmarks,
                "How many landmarks were in range of a pose driven; the others are in no covariance yet.",
            ),
            Readout::new(
                "rho",
                "ρ of the entry",
                rho,
                signed(rho),
                "",
                "Correlation of the two coordinates that are named, from −1 to 1.",
            ),
            Readout::new(
                "largest",
                "Largest |ρ|",
                largest,
                signed(largest),
                "",
                "Of all pairs of landmarks: the largest correlation of any direction of one with any direction of the other.",
            ),
            Readout::new(
                "mean",
                "Mean |ρ|",
                mean,
                signed(mean),
                "",
                "The same, on the average of all pairs: the mean width of an arc.",
            ),
            count(
                "off_block",
                "Off-block entries ≠ 0",
                self.map().off_block_nonzeros(),
                self.off_block(),
                "Entries of the covariance that couple two landmarks and are not exactly 0, counted.",
            ),
            Readout::new(
                "largest_std",
                "Least known landmark",
                largest_std,
                fixed(largest_std, 3),
                "m",
                "Standard deviation of the least known landmark along its least known direction.",
            ),
            entries(
                "ekf",
                "One sighting, EKF",
                self.ekf_entries(),
                "Entries of its covariance that an EKF over pose and map changes at one sighting: (2 N + 3)².",
            ),
            entries(
                "fastslam",
                "One sighting, FastSLAM",
                4,
                "Entries that each particle changes at one sighting: the 2 × 2 covariance of the landmark seen.",
            ),
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
        Series { columns: COLUMNS, rows: (0..=self.step).map(row).collect() }
    }

    fn describe(&self) -> String {
        if self.step == 0 {
            return "No pose driven yet: the robot stands at its known start, and has seen no landmark.".into();
        }
        let (seen, off_block) = (self.covariances.seen.len(), self.off_block());
        let driven = format!("{} of {} poses driven, {seen} landmarks seen. ", self.step, self.setup().poses);
        let coupled =
            format!("{} of {off_block} entries outside the blocks are not 0. ", self.map().off_block_nonzeros());
        let how = if self.conditioned {
            "Given the path every landmark stands alone: "
        } else {
            "With the path unknown, its errors are in every landmark: "
        };
        driven + how + &coupled + &self.entry_text() + self.why() + "."
    }

    fn height(&self, width: f64) -> f64 {
        // Narrower than the layout goes, the figure is made smaller as a whole.
        Layout::new(width).height * (width / width.max(NARROWEST))
    }

    fn scene(&self, width: f64, height: f64) -> Scene {
        scene::build(self, width, height)
    }
}

impl ConditioningModel {
    /// What the landmarks of the entry have to do with each other, after its number.
    fn why(&self) -> &'static str {
        let [a, b] = self.entry.map(|k| k / 2);
        let coupled = a != b && self.correlation().is_some() && !self.conditioned;
        match self.seen_together(a, b) {
            0 if coupled => ", though no pose saw both",
            _ if coupled => ", both seen from one pose",
            _ => "",
        }
    }
}
