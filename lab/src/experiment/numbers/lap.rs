//! The Apartment lap: its setting, the lap table and what stands beside it, and the memory of its maps.

use super::{Group, Made, Number, Recipe, Runs, SEEDS, VALID};
use crate::experiment::ErrorSummary;
use crate::experiment::ProposalKind;
use crate::experiment::lap::{BEAMS, GRID, LAG, Lap, LapSetup, LapWorld, MAX_RANGE, STEPS, ScanWeight};
use crate::experiment::table::{LapResult, PARTICLES, rms_best};
use crate::experiment::universes::{TRIED, WELL};
use fastslam::execute::Executor;
use fastslam::geometry::rms;
use fastslam::matching::Matcher;

/// A lap that ends with a larger error \[m\] is counted as a disaster: that floor plan serves nobody.
const DISASTER: f64 = 1.0;

/// What a lap is judged by.
const ERROR: &str = "the RMS position error of the best particle's path over the Apartment lap";

/// All recipes of the lap.
pub fn recipes() -> Vec<Recipe> {
    let table = LapCell::all().map(|cell| {
        Recipe::new(cell.name(), SEEDS, move |runs| {
            let errors = cell.errors(runs);
            Made { numbers: cell.numbers(&errors), errors }
        })
    });
    // A scan matcher that never looks back; and as many particles as it takes to look up as many beams as four measurement-aware ones
    // do, some 60 scans each: 45 poses of the search by every second beam, 39 of curvature, quadrature and weight by all.
    let beside = [(ProposalKind::Improved, 1), (ProposalKind::Motion, 240)].map(|(proposal, particles)| {
        let cell = LapCell { proposal, matcher: Matcher::SubCell, particles };
        Recipe::new(cell.name(), SEEDS, move |runs| cell.numbers(&cell.errors(runs)).into())
    });
    let aligned = "the RMS position error of the best particle's path after its best rigid alignment with the truth";
    let of_one = "the first step at which all particles descend from one";
    // The table's filters, each by the weight of the other.
    let weights = [(ProposalKind::Improved, ScanWeight::Marginal), (ProposalKind::Motion, ScanWeight::NewGroundFree)];
    let weights = weights.map(|(proposal, weight)| weighed(proposal, weight));
    let medians = [
        median_of(ProposalKind::Improved, Matcher::Cell, "aligned", "m", aligned, |lap| lap.rms_best_aligned),
        median_of(ProposalKind::Improved, Matcher::SubCell, "aligned", "m", aligned, |lap| lap.rms_best_aligned),
        median_of(ProposalKind::Motion, Matcher::SubCell, "lineage_one_step", "", of_one, lineage_of),
    ];
    let others = [setting(), odometry(), memory(), blunt(1), blunt(16), four_seeds()];
    let sufficient = [ProposalKind::Improved, ProposalKind::Motion].map(sufficient);
    let besides = [ProposalKind::Improved, ProposalKind::Motion].into_iter().flat_map(|proposal| {
        let cells = TRIED.map(|particles| LapCell { proposal, matcher: Matcher::SubCell, particles });
        cells.into_iter().filter(|cell| !PARTICLES.contains(&cell.particles)).map(tried)
    });
    table.chain(beside).chain(weights).chain(medians).chain(others).chain(sufficient).chain(besides).collect()
}

/// A cell of the lap table: errors over many laps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LapCell {
    /// Its column.
    pub proposal: ProposalKind,
    /// Its column.
    pub matcher: Matcher,
    /// M, its row.
    pub particles: usize,
}

impl LapCell {
    /// All cells, column by column.
    pub fn all() -> impl Iterator<Item = Self> {
        let columns = [ProposalKind::Improved, ProposalKind::Motion]
            .into_iter()
            .flat_map(|proposal| [Matcher::Cell, Matcher::SubCell].map(|matcher| (proposal, matcher)));
        columns.flat_map(|(proposal, matcher)| PARTICLES.map(|particles| Self { proposal, matcher, particles }))
    }

    /// What its keys begin with: `lap.aware.cell.m16`.
    pub fn name(&self) -> String {
        let Self { proposal, matcher, particles } = self;
        format!("lap.{proposal}.{matcher}.m{particles}")
    }

    /// Its lap with a seed.
    pub fn setup(&self, seed: u64) -> LapSetup {
        let &Self { proposal, matcher, particles } = self;
        LapSetup { proposal, matcher, particles, seed, ..LapSetup::default() }
    }

    /// What runs its laps natively.
    fn command(&self) -> String {
        let Self { proposal, matcher, particles } = self;
        format!("fastslam-lab lap --proposal {proposal} --matcher {matcher} --particles {particles} --seed N")
    }

    /// The numbers of the cell, from the errors of seeds 1 to their number.
    pub fn numbers(&self, errors: &[f64]) -> Vec<Number> {
        let group = Group(self.name());
        let what = format!("{ERROR}: {}", self.command());
        let [low, high] = ErrorSummary::of(errors).median_interval;
        let end = |which| {
            format!(
                "{which} end of the 95 % confidence interval of the median (order statistics) over seeds 1 to {} of {what}",
                errors.len()
            )
        };
        let mut numbers = group.spread(errors, &what);
        numbers.push(group.number("median_low", low, "m", end("Lower")));
        numbers.push(group.number("median_high", high, "m", end("Upper")));
        let disasters: Vec<f64> = errors.iter().copied().filter(|error| *error > DISASTER).collect();
        let of = format!("of seeds 1 to {} that ended with more than {DISASTER} m of {what}", errors.len());
        numbers.push(group.number("disasters", disasters.len() as f64, "", format!("Number of those {of}")));
        if !disasters.is_empty() {
            let median = ErrorSummary::of(&disasters).median;
            numbers.push(group.number("disasters.median", median, "m", format!("Median of those {of}")));
        }
        numbers
    }

    fn errors(&self, runs: &Runs<'_>) -> Vec<f64> {
        runs.over(|seed| rms_best(&self.setup(seed)).expect(VALID))
    }
}

/// Errors of the sub-cell column of the default M, where another weight is paid for a scan.
fn weighed(proposal: ProposalKind, weight: ScanWeight) -> Recipe {
    let cell = LapCell { proposal, matcher: Matcher::SubCell, particles: LapSetup::default().particles };
    let name = format!("lap.{proposal}.{weight}");
    let group = Group(name.clone());
    let what = format!("{ERROR}: {} --weight {weight}", cell.command());
    Recipe::new(name, SEEDS, move |runs| {
        let errors = runs.over(|seed| rms_best(&LapSetup { weight, ..cell.setup(seed) }).expect(VALID));
        group.spread(&errors, &what).into()
    })
}

/// How often a table of four laps in each cell would have a larger worst error in its last row than in some row above, column by
/// column: worked out from the errors of all laps of the table.
fn four_seeds() -> Recipe {
    Recipe::new("lap.four", 0, |runs| {
        let group = Group("lap.four".into());
        let columns = LapCell::all().filter(|cell| cell.particles == PARTICLES[0]);
        let of_column = |column: LapCell| {
            let errors = PARTICLES.map(|particles| runs.before.get(&LapCell { particles, ..column }.name()));
            let rows: Vec<&[f64]> =
                errors.into_iter().map(|errors| errors.map(Vec::as_slice)).collect::<Option<_>>()?;
            let LapCell { proposal, matcher, .. } = column;
            let made = format!(
                "Chance that of four laps drawn at random for each M of {PARTICLES:?}, from the {} of the lap table, the worst of the last M is larger than that of some smaller: {proposal}, {matcher}",
                rows[0].len()
            );
            Some(group.number(&format!("{proposal}.{matcher}"), chance_of_a_worse_last(&rows), "", made))
        };
        columns.filter_map(of_column).collect::<Vec<_>>().into()
    })
}

/// The chance that the largest of four errors drawn at random from the last row is larger than the largest of four from some row above;
/// what was drawn may be drawn again.
///
/// 1 − Σ_v P(largest of the last = v) ∏ P(largest of the row ≥ v), where P(largest of four ≤ v) = F(v)⁴ for the share F of a row.
fn chance_of_a_worse_last(rows: &[&[f64]]) -> f64 {
    let all_four = |share: f64| share * share * share * share;
    let Some((last, above)) = rows.split_last() else { return 0.0 };
    let share = |of: &[f64], under: &dyn Fn(f64) -> bool| {
        of.iter().filter(|error| under(**error)).count() as f64 / of.len() as f64
    };
    let mut values = last.to_vec();
    values.sort_unstable_by(f64::total_cmp);
    values.dedup();
    let none_is_smaller = |v: f64| -> f64 {
        let is_v = all_four(share(last, &|error| error <= v)) - all_four(share(last, &|error| error < v));
        is_v * above.iter().map(|row| 1.0 - all_four(share(row, &|error| error < v))).product::<f64>()
    };
    1.0 - values.into_iter().map(none_is_smaller).sum::<f64>()
}

/// What is set on the lap.
fn setting() -> Recipe {
    Recipe::fixed("lap", |group| {
        let start = "The setting of the lap (lab/src/experiment/lap.rs)";
        vec![
            group.number("steps", STEPS as f64, "", format!("{start}: steps after the start")),
            group.number("runs", f64::from(SEEDS), "", "Seeds of every cell of the lap table, from 1 on"),
            group.number(
                "lag",
                f64::from(LAG),
                "",
                format!("{start}: scans since the map that a scan is weighed against"),
            ),
            group.number("cell", GRID.cell_size, "m", format!("{start}: width of a cell of the maps")),
            group.number("scan.beams", BEAMS as f64, "", format!("{start}: beams of a scan")),
            group.number("scan.range", MAX_RANGE, "m", format!("{start}: longest range of a beam")),
            group.number("scan.range_std", LapSetup::default().range_std, "m", format!("{start}: σ of a range")),
            group.number(
                "particles.default",
                LapSetup::default().particles as f64,
                "",
                format!("{start}: M of the figure"),
            ),
        ]
    })
}

fn odometry() -> Recipe {
    Recipe::new("lap.odometry", SEEDS, |runs| {
        let error = |seed| {
            let setup = LapSetup::default();
            let world = LapWorld::new(seed, &setup.motion(), setup.range_std);
            rms(&world.odometry, &world.truth)
        };
        let what = "the RMS position error of raw odometry over the Apartment lap: fastslam-lab lap --seed N";
        Group("lap.odometry".into()).spread(&runs.over(error), what).into()
    })
}

fn memory() -> Recipe {
    Recipe::fixed("memory.lap", |group| {
        let setup = LapSetup::default();
        let (lap, _) = Lap::new(&setup).expect(VALID).with_executor(Executor::Serial).run(|_| ());
        let (unique, dense) = (lap.report().map_bytes_unique as f64, lap.report().map_bytes_dense as f64);
        let of = format!("at the end of a lap: fastslam-lab lap --particles {} --seed {}", setup.particles, setup.seed);
        vec![
            group.number("unique", unique, "bytes", format!("All maps, shared tiles counted once, {of}")),
            group.number("dense", dense, "bytes", format!("As many dense maps of the same extent, {of}")),
            group.number("ratio", dense / unique, "", format!("Dense over shared bytes {of}")),
        ]
    })
}

/// A median of what else is known of a cell's laps, where there is one.
fn median_of(
    proposal: ProposalKind,
    matcher: Matcher,
    key: &str,
    unit: &'static str,
    what: &'static str,
    measure: fn(&LapResult) -> f64,
) -> Recipe {
    let cell = LapCell { proposal, matcher, particles: 40 };
    let key = format!("{}.{key}", cell.name());
    Recipe::new(key.clone(), SEEDS, move |runs| {
        let found = runs.over(|seed| measure(&LapResult::of(&cell.setup(seed)).expect(VALID)));
        let value = ErrorSummary::of(&found).median;
        let made = format!("Median over seeds 1 to {} of {what}: {}", runs.seeds, cell.command());
        Vec::from_iter(value.is_finite().then(|| Number { key: key.clone(), value, unit, made })).into()
    })
}

fn lineage_of(lap: &LapResult) -> f64 {
    lap.lineage_one_step.map_or(f64::INFINITY, f64::from)
}

/// Laps whose sensor is ten times as blunt.
fn blunt(particles: usize) -> Recipe {
    let cell = LapCell { proposal: ProposalKind::Improved, matcher: Matcher::SubCell, particles };
    let name = format!("lap.blunt.{}.m{particles}", cell.matcher);
    Recipe::new(name.clone(), SEEDS, move |runs| {
        let setup = |seed| LapSetup { range_std: 10.0 * LapSetup::default().range_std, ..cell.setup(seed) };
        let errors = runs.over(|seed| rms_best(&setup(seed)).expect(VALID));
        let what = format!("{ERROR}: {} --range-std {}", cell.command(), setup(1).range_std);
        Group(name.clone()).spread(&errors, &what).into()
    })
}

/// The errors that the figure of universes has besides those of the table: of every M that is tried.
fn tried(cell: LapCell) -> Recipe {
    let name = format!("lap.tried.{}.{}.m{}", cell.proposal, cell.matcher, cell.particles);
    Recipe::new(name, SEEDS, move |runs| Made { numbers: Vec::new(), errors: cell.errors(runs) })
}

/// The smallest M with which most laps end well.
fn sufficient(proposal: ProposalKind) -> Recipe {
    let matcher = Matcher::SubCell;
    let key = format!("lap.sufficient.{proposal}.{matcher}");
    Recipe::new(key.clone(), SEEDS, move |runs| {
        let enough = |particles: &usize| {
            let errors = LapCell { proposal, matcher, particles: *particles }.errors(&runs.quietly());
            5 * errors.iter().filter(|error| **error < WELL).count() >= 4 * errors.len()
        };
        let least = TRIED.into_iter().find(enough);
        runs.all_done();
        let made = format!(
            "Smallest M of {TRIED:?} with which at least four fifths of seeds 1 to {} end with an RMS position error under {WELL} m: fastslam-lab lap --proposal {proposal} --matcher {matcher} --particles M --seed N",
            runs.seeds
        );
        Vec::from_iter(least.map(|least| Number { key: key.clone(), value: least as f64, unit: "", made })).into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every table of four out of two errors in each of three rows, 2¹² of them, counted one by one; sums of 16 parts of 4096.
    #[test]
    fn the_chance_of_a_worse_last_row_is_that_of_counting_all_tables() {
        let rows = [[0.1, 0.5], [0.3, 0.4], [0.2, 0.4]];
        let table = |code: u32| {
            let drawn = |row: usize| (0..4).map(move |k| rows[row][(code >> (4 * row + k) & 1) as usize]);
            [0, 1, 2].map(|row| drawn(row).fold(0.0, f64::max))
        };
        let worse = (0..1 << 12).map(table).filter(|[first, second, last]| last > first || last > second).count();
        let chance = chance_of_a_worse_last(&rows.each_ref().map(|row| &row[..]));
        assert!((chance - worse as f64 / 4096.0).abs() < 1e-12, "{chance} {worse}");
    }

    #[test]
    fn disasters_are_the_errors_over_a_metre() {
        let cell = LapCell { proposal: ProposalKind::Motion, matcher: Matcher::SubCell, particles: 4 };
        let of = |errors: &[f64], key: &str| {
            let key = format!("{}.{key}", cell.name());
            cell.numbers(errors).into_iter().find(|number| number.key == key).map(|number| number.value)
        };
        let errors = [0.2, 3.0, 1.0, 1.5, 2.0];
        assert_eq!((of(&errors, "disasters"), of(&errors, "disasters.median")), (Some(3.0), Some(2.0)));
        assert_eq!((of(&[0.2, 1.0], "disasters"), of(&[0.2, 1.0], "disasters.median")), (Some(0.0), None));
    }
}
