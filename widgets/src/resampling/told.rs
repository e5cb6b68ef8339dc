//! What is told of the three filters: the step in words, the lines of the algorithm, the readouts and the data.

use super::stroke;
use super::{
    challenges,
    model::{Moment, ResamplingModel},
    recipe::SELECTIVE,
};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::model::{Column, Model, Readout, Series, Tells, TraceLine};
use crate::names;
use crate::prediction::{State, off_by};
use crate::told::{ess_text, pose_text};
use crate::words::{common, resampling};
use fastslam_lab::experiment::resampling::{POLICIES, PolicyCourse};

impl Tells for ResamplingModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (step, m) = (self.cursor(), self.setup().particles);
        let mut readouts = Vec::new();
        for (policy, names) in NAMES.iter().enumerate() {
            let Moment { report, resampled, .. } = self.read(policy);
            let of_all = |x: f64, text: String| (x, common::Of { n: &text, all: &m }.say());
            let (ess, ess_text) = of_all(report.ess, fixed(report.ess, 1));
            let lineage = report.descent.lineage(step);
            let (lineage, lineage_text) = of_all(lineage.into(), lineage.to_string());
            let (nodes, paths) = (report.tree_nodes(), report.path_nodes(m));
            let [ess_name, lineage_name, error_name, tree_name, right_name, resampled_name] = names.readouts;
            readouts.extend([
                Readout::new(ess_name.0, ess_name.1(), ess, ess_text, "", resampling::ess_help()).drawn(),
                Readout::new(lineage_name.0, lineage_name.1(), lineage, lineage_text, "", resampling::lineage_help())
                    .drawn(),
                Readout::new(
                    error_name.0,
                    error_name.1(),
                    report.error_best,
                    fixed(report.error_best, 2),
                    "m",
                    resampling::error_help(),
                )
                .drawn(),
                Readout::new(
                    tree_name.0,
                    tree_name.1(),
                    f64::from(nodes),
                    common::Of { n: &nodes, all: &paths }.say(),
                    resampling::nodes_unit(),
                    resampling::tree_help(),
                ),
            ]);
            let of_the_course = match (self.setup().course, report.right) {
                (PolicyCourse::Lap, _) => Readout::new(
                    resampled_name.0,
                    resampled_name.1(),
                    f64::from(*resampled),
                    common::Of { n: resampled, all: &step }.say(),
                    resampling::steps(),
                    resampling::resampled_help(),
                ),
                (PolicyCourse::Wings, right) => Readout::new(
                    right_name.0,
                    right_name.1(),
                    right.map_or(f64::NAN, f64::from),
                    common::Of { n: &right.unwrap_or(0), all: &m }.say(),
                    "",
                    resampling::right_help(),
                ),
            };
            readouts.push(of_the_course.drawn());
        }
        if self.prediction().is_some() {
            let result = self.one_left();
            let (value, text) =
                (result.map_or(f64::NAN, f64::from), result.map_or(String::new(), |step| step.to_string()));
            let one_left =
                Readout::new("one_left", resampling::one_left(), value, text, "", resampling::one_left_help());
            readouts.push(one_left.drawn());
        }
        readouts
    }

    fn series(&self) -> Series {
        let row = |(step, all): (usize, &[Moment; 3])| {
            let of = |Moment { report, .. }: &Moment| {
                [
                    report.log_evidence,
                    report.ess,
                    f64::from(u8::from(report.resampled())),
                    f64::from(report.descent.lineage(report.step)),
                    f64::from(report.descent.lineage(self.back())),
                    report.error_best,
                    report.error_mean,
                    report.rms_best,
                    f64::from(report.tree_nodes()),
                    report.right.map_or(f64::NAN, f64::from),
                ]
            };
            core::iter::once(step as f64).chain(all.iter().flat_map(of)).collect()
        };
        Series { columns: COLUMNS.into(), rows: self.moments().iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        let (step, last, m) = (self.cursor(), self.course_steps(), self.setup().particles);
        if step == 0 {
            let at = resampling::AtStep { step: &step, last: &last, m: &m }.say();
            let said = predicted(self).into_iter().chain([at, resampling::at_start().into()]);
            return said.collect::<Vec<_>>().join(" ");
        }
        let all = [0, 1, 2].map(|policy| self.read(policy));
        let [never, always, selective] = all.map(|moment| fixed(moment.report.ess, 1));
        let [a, b, c] = all.map(|moment| moment.report.descent.lineage(step));
        let ancestors = resampling::AncestorsLeft { a: &a, b: &b, c: &c }.say();
        let told = if let [Some(a), Some(b), Some(c)] = all.map(|moment| moment.report.right) {
            let ess = resampling::NEffOfAll { never: &never, always: &always, selective: &selective }.say();
            let ancestors = &ancestors;
            resampling::ToldWings { step: &step, last: &last, a: &a, b: &b, c: &c, m: &m, ess: &ess, ancestors }.say()
        } else {
            let [never, always, selective, ancestors] = [&never, &always, &selective, &ancestors];
            resampling::Told { step: &step, last: &last, m: &m, never, always, selective, ancestors }.say()
        };
        let [a, b, c] = all.map(|moment| moment.resampled);
        let scheme = names::scheme(self.setup().scheme);
        let times = resampling::ResampledTimes { a: &a, b: &b, c: &c, scheme: &scheme }.say();
        let [a, b, c] = all.map(|moment| fixed(moment.report.error_best, 2));
        let mut sentences: Vec<_> = predicted(self).into_iter().collect();
        sentences.extend([told, times, resampling::OffBy { a: &a, b: &b, c: &c }.say()]);
        let unexplained =
            [resampling::never_unexplained(), resampling::always_unexplained(), resampling::selective_unexplained()];
        let lost = all.iter().zip(unexplained).filter(|(moment, _)| moment.report.log_evidence == f64::NEG_INFINITY);
        sentences.extend(lost.map(|(_, says)| says.to_string()));
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        if let Some(predicted) = predicted(self) {
            return predicted;
        }
        let (step, m) = (self.cursor(), &self.setup().particles);
        if step == 0 {
            return resampling::n_start().into();
        }
        let all = [0, 1, 2].map(|policy| self.read(policy));
        if let [Some(a), Some(b), Some(c)] = all.map(|moment| moment.report.right) {
            return resampling::NWings { m, a: &a, b: &b, c: &c }.say();
        }
        let [a, b, c] = all.map(|moment| moment.report.descent.lineage(step));
        resampling::NTold { m, a: &a, b: &b, c: &c }.say()
    }

    /// Of the selective filter's best particle at the step that is read, among landmarks.
    fn trace(&self) -> Vec<TraceLine> {
        let (m, moment) = (self.setup().particles, self.read(SELECTIVE));
        let Some((associations, answers)) = moment.report.associations else { return Vec::new() };
        let pose = moment.poses[moment.best];
        let survivors = moment.report.descent.lineage(0);
        let ess = ess_text(moment.report.ess, m);
        let mut lines = vec![TraceLine::new("predict", "")];
        if associations.again + associations.first > 0 {
            let (again, first) = (&associations.again, &associations.first);
            let made_of_it = if answers == 1 {
                resampling::KnownAllAgree { again, first }.say()
            } else {
                resampling::KnownAnswers { again, first, answers: &answers }.say()
            };
            lines.extend([
                TraceLine::new("gate", ""),
                TraceLine::new("associate", made_of_it),
                TraceLine::new("weigh", format!("{} nats", fixed(associations.log_increment, 1))),
            ]);
        }
        if associations.again > 0 {
            lines.push(TraceLine::new("fold", ""));
        }
        lines.push(TraceLine::new("draw", pose_text([pose.x, pose.y, pose.theta])));
        if associations.again + associations.first > 0 {
            let done = resampling::Updated { again: &associations.again, first: &associations.first }.say();
            lines.push(TraceLine::new("assimilate", done));
        }
        lines.push(TraceLine::new("extend", resampling::Nodes { n: &moment.report.tree_nodes() }.say()));
        lines.push(TraceLine::new(
            "resample",
            if moment.report.resampled() {
                resampling::Resamples { ess: &ess, survivors: &survivors }.say()
            } else {
                resampling::ResamplesNot { ess: &ess }.say()
            },
        ));
        lines
    }
}

/// What is said of the prediction, if one is asked for.
fn predicted(model: &ResamplingModel) -> Option<String> {
    let policy = &stroke::NAMES[model.chosen()]();
    let (result, over) = (model.one_left(), model.pending() == 0);
    let says = match (model.state(), result) {
        (State::Off, _) => return None,
        (State::Asked, _) => resampling::Asks { policy }.say(),
        (State::Placed(guess), _) => resampling::Placed { policy, guess: &write(guess) }.say(),
        (State::Guessed(guess), Some(result)) => {
            let off = &off_by(guess, result.into());
            resampling::Came { result: &result, guess: &write(guess), off }.say()
        }
        (State::Waived, Some(result)) => resampling::CameWaived { result: &result }.say(),
        (State::Guessed(guess), None) if over => resampling::NeverCame { guess: &write(guess) }.say(),
        (State::Waived, None) if over => resampling::never_came_waived().into(),
        _ => return None,
    };
    Some(says)
}

/// Identifier and title of a number.
type Name = (&'static str, fn() -> &'static str);

/// What one filter's numbers are called.
struct Names {
    /// Identifier and title of N_eff, lineage, error, tree, right wing and steps resampled.
    readouts: [Name; 6],
}

/// In the order of [`POLICIES`].
const NAMES: [Names; POLICIES.len()] = [
    Names {
        readouts: [
            ("never_ess", resampling::never_ess),
            ("never_lineage", resampling::never_lineage),
            ("never_error_best", resampling::never_error_best),
            ("never_tree", resampling::never_tree),
            ("never_right", resampling::never_right),
            ("never_resampled", resampling::never_resampled),
        ],
    },
    Names {
        readouts: [
            ("always_ess", resampling::always_ess),
            ("always_lineage", resampling::always_lineage),
            ("always_error_best", resampling::always_error_best),
            ("always_tree", resampling::always_tree),
            ("always_right", resampling::always_right),
            ("always_resampled", resampling::always_resampled),
        ],
    },
    Names {
        readouts: [
            ("selective_ess", resampling::selective_ess),
            ("selective_lineage", resampling::selective_lineage),
            ("selective_error_best", resampling::selective_error_best),
            ("selective_tree", resampling::selective_tree),
            ("selective_right", resampling::selective_right),
            ("selective_resampled", resampling::selective_resampled),
        ],
    },
];

macro_rules! columns {
    ($($name:literal)*) => {
        &[
            Column::new("step", "step of the course"),
            $(
                Column::new(concat!($name, "_mean_increment_nats"), "log of the weighted mean of what the universes pay for the scan [nats]: of a score, not evidence"),
                Column::new(concat!($name, "_ess"), "effective number of particles before resampling"),
                Column::new(concat!($name, "_resampled"), "1 where the step resampled"),
                Column::new(concat!($name, "_lineage"), "distinct ancestors at step 0"),
                Column::new(concat!($name, "_lineage_back"), "distinct ancestors as many steps back as the second gauge looks"),
                Column::new(concat!($name, "_error_best_m"), "distance of the best particle from the truth [m]"),
                Column::new(concat!($name, "_error_mean_m"), "distance of the weighted mean from the truth [m]"),
                Column::new(concat!($name, "_rms_best_m"), "RMS position error of the best particle's path so far [m]"),
                Column::new(concat!($name, "_tree_nodes"), "poses that the particles still need, each counted once"),
                Column::new(concat!($name, "_right"), "particles that hold the true explanation, from where there are two"),
            )*
        ]
    };
}

const COLUMNS: &[Column] = columns!("never" "always" "selective");
