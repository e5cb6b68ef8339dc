//! What is told of both filters in numbers and in words.

use super::{challenges, model::DoorsModel};
use crate::{
    challenge::Challenge,
    decimal::fixed,
    model::{Column, Model, Readout, Series, Tells},
    words::doors as words,
};
use fastslam_lab::experiment::doors::{Belief, FARTHEST};

/// What a filter takes the landmark in view for, in words.
pub fn belief(model: &DoorsModel, belief: Belief) -> String {
    match belief {
        Belief::Nothing => words::nothing_seen().into(),
        Belief::New => words::something_new().into(),
        Belief::Landmark(rank) if rank as usize == model.setup().doors.len() => words::the_sign().into(),
        Belief::Landmark(rank) => words::DoorNumber { n: &(rank + 1) }.say(),
    }
}

/// How many doors off, with its sign: 0, +1, −2.
pub fn off(doors: i32) -> String {
    match doors {
        0 => "0".into(),
        1.. => format!("+{doors}"),
        _ => format!("−{}", doors.abs()),
    }
}

/// Who is right, in a word.
pub fn verdict(right: bool) -> &'static str {
    if right { words::right() } else { words::wrong() }
}

/// A deviation \[m\] in words: in centimetres where it is small.
pub fn deviation(std: f64) -> String {
    if std < 0.995 { format!("{} cm", fixed(100.0 * std, 0)) } else { format!("{} m", fixed(std, 1)) }
}

impl Tells for DoorsModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let now = self.now();
        let alive = now.explanations(self.setup());
        let yes = |right: bool| f64::from(u8::from(right));
        let rank = |belief: Belief| if let Belief::Landmark(rank) = belief { f64::from(rank + 1) } else { f64::NAN };
        let (best, ekf) = (self.off(now.places[now.best]), self.ekf_off());
        let ekf_door = Readout {
            text: belief(self, now.ekf_belief),
            ..Readout::new("ekf_door", words::ekf_door(), rank(now.ekf_belief), "", "", words::ekf_door_help())
        };
        vec![
            Readout::new("alive", words::alive(), alive.into(), alive.to_string(), "", words::alive_help()).drawn(),
            Readout::new("best_off", words::best_off(), best.into(), off(best), words::doors_unit(), words::off_help()),
            Readout::new(
                "fastslam_right",
                words::fastslam_right(),
                yes(now.fastslam_right()),
                verdict(now.fastslam_right()),
                "",
                words::right_help(),
            )
            .drawn(),
            Readout::new("ess", "N_eff", now.ess, fixed(now.ess, 1), "", words::ess_help()),
            ekf_door.drawn(),
            Readout::new("ekf_std", words::ekf_std(), now.ekf_std, fixed(now.ekf_std, 3), "m", words::ekf_std_help())
                .drawn(),
            Readout::new("ekf_off", words::ekf_off(), ekf.into(), off(ekf), words::doors_unit(), words::off_help()),
            Readout::new(
                "ekf_right",
                words::ekf_right(),
                yes(now.ekf_right()),
                verdict(now.ekf_right()),
                "",
                words::right_help(),
            )
            .drawn(),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("step", "step of the drive"),
            Column::new("truth_m", "where the robot is [m]"),
            Column::new("alive", "explanations with 1 % of the weight"),
            Column::new("share_right", "share of the weight that is off by no door"),
            Column::new("ess", "effective number of particles before resampling"),
            Column::new("resampled", "1 where the step resampled"),
            Column::new("best_m", "where the best particle is [m]"),
            Column::new("ekf_m", "where EKF-SLAM is in the mean [m]"),
            Column::new("ekf_std_m", "its standard deviation [m]"),
        ];
        let row = |report: &fastslam_lab::experiment::doors::DoorsReport| {
            vec![
                f64::from(report.step),
                report.truth,
                f64::from(report.explanations(self.setup())),
                report.shares(self.setup())[FARTHEST as usize],
                report.ess,
                f64::from(u8::from(report.resampled)),
                report.places[report.best],
                report.ekf_place,
                report.ekf_std,
            ]
        };
        Series { columns: COLUMNS.into(), rows: self.history().iter().map(row).collect() }
    }

    fn describe(&self) -> String {
        let (now, setup) = (self.now(), self.setup());
        let (step, last) = (&self.step(), &self.step_count());
        if !self.is_carried() {
            return words::Maps { step, last, doors: &setup.doors.len() }.say();
        }
        let alive = &now.explanations(setup);
        let particles = &verdict(now.fastslam_right());
        let std = &deviation(now.ekf_std);
        let told = words::Told {
            step,
            last,
            alive,
            m: &setup.particles,
            best: &off(self.off(now.places[now.best])),
            particles,
        };
        let door = &belief(self, now.ekf_belief);
        let ekf = words::ToldEkf { door, std, off: &off(self.ekf_off()), right: &verdict(now.ekf_right()) };
        [told.say(), ekf.say()].join(" ")
    }

    fn narrate(&self) -> String {
        let (now, setup) = (self.now(), self.setup());
        if !self.is_carried() {
            return words::NMaps { doors: &setup.doors.len() }.say();
        }
        let (particles, ekf) = (&verdict(now.fastslam_right()), &verdict(now.ekf_right()));
        match &now.explanations(setup) {
            0 | 1 => words::NOne { particles, ekf }.say(),
            alive => words::NSeveral { alive, ekf }.say(),
        }
    }
}
