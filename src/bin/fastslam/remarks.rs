//! What is said of a run among landmarks whose result is not to be trusted: beside it, on standard error and in JSON as `remarks`.

use fastslam_lab::experiment::innovations::agreeing;

/// What is known of a run at its end; of several, the medians.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// Innovations: how many there were, their mean square when normalised, and the share beyond the 99 % bound.
    pub innovations: (u32, Option<f64>, f64),
    /// Whether the filter was to find out by itself which landmark it sees.
    pub unknown: bool,
    /// Drift of the odometry, per metre ahead \[rad/m\] and per radian turned \[–\], where it was learnt.
    pub drift: Option<[f64; 2]>,
    /// Landmarks in the best map.
    pub left: f64,
    /// Landmarks that were founded on the way, by the best particles.
    pub founded: f64,
    /// Different landmarks that were truly seen, where their names are known; 0 where they are not.
    pub there: f64,
    /// Share of the steps in the longest stretch in which no landmark of the best map was seen.
    pub blind: f64,
    /// RMS errors of position as it went, of the filter and of raw odometry \[m\].
    pub errors: [f64; 2],
    /// RMS error of position as it went of EKF-SLAM that is told the same \[m\].
    pub ekf: f64,
    /// By how many times successive looks differ more than the noises that were told allow; 1 where that is not sure.
    pub excess: f64,
    /// Landmarks with names of which what was seen contradicts the noises that were told.
    pub contradicting: f64,
    /// Landmarks with names that were not seen any more where they should have been.
    pub gone: f64,
    /// Features with names, and how many of them were taken for a landmark never seen before beyond the first of each name.
    pub named: f64,
    pub founded_again: f64,
    /// Standard deviation of a range that was told \[m\].
    pub range_std: f64,
}

/// Without names: of a map of which less than this share is left, too much was struck off. Other robots, which come and go, take two thirds.
const LEAST_LEFT: f64 = 0.2;

/// Longest stretch without a landmark of the map, as a share of the steps, that is not worth a word.
const LONGEST_BLIND: f64 = 0.25;

/// Most landmarks founded again for each name, and as a share of the features with names, that are not worth a word. Of posts 18 cm apart, and among
/// robots that stand before them, each is founded up to five times.
const AGAIN: f64 = 6.0;
const AGAIN_SHARE: f64 = 0.05;

/// Fewest landmarks that are told of by themselves, and their least share: one in a long drive may differ by chance, and a few of many where particles are few.
const SOME: f64 = 2.0;
const MANY: f64 = 0.1;

/// Largest error of the filter, as a share of that of raw odometry, where its landmarks help.
const HELPED: f64 = 0.7;

/// How many times the error of EKF-SLAM that of the filter may be without a word.
const BEHIND: f64 = 2.0;

impl Outcome {
    /// The remarks, each with what to change. `noises` are the options that set the noise of the odometry.
    pub fn remarks(&self, noises: &[&str]) -> Vec<String> {
        let noise = self.of_noises(noises).or_else(|| self.of_looks(noises)).or_else(|| self.of_some());
        [noise, self.of_landmarks(noises), self.of_gone(), self.of_names(), self.of_stretches(), self.of_errors()]
            .into_iter()
            .flatten()
            .collect()
    }

    /// Where the filter chooses the landmark, its innovations agree whatever it is told.
    fn of_looks(&self, noises: &[&str]) -> Option<String> {
        (self.excess > 1.0).then(|| {
            format!(
                "successive measurements of what must be one landmark differ by {:.1} times as much as the noises that were told allow: tell larger \
                 noises ({})",
                self.excess,
                options(noises)
            )
        })
    }

    fn of_some(&self) -> Option<String> {
        (self.contradicting >= SOME.max(MANY * self.there)).then(|| {
            format!(
                "what was seen of {} of {} landmarks contradicts the noises that were told, while the others agree: they may have been moved, or names be \
                 mistaken",
                self.contradicting, self.there
            )
        })
    }

    fn of_gone(&self) -> Option<String> {
        (self.gone >= SOME.max(MANY * self.there)).then(|| {
            format!(
                "{} of {} landmarks were seen again and again and then no more, while they should have been in view: they may have gone; they stay in the map",
                self.gone, self.there
            )
        })
    }

    fn of_names(&self) -> Option<String> {
        let Self { there, founded_again, named, .. } = *self;
        if !self.unknown || there == 0.0 {
            return None;
        }
        (founded_again > AGAIN * there && founded_again > AGAIN_SHARE * named).then(|| {
            format!(
                "{founded_again} observations of the {there} landmarks that were mapped already were taken for new ones: the noises that were told are too small, \
                 or odometry, clocks and measurements contradict each other; tell larger noises"
            )
        })
    }

    fn of_noises(&self, noises: &[&str]) -> Option<String> {
        let (count, Some(mean), beyond) = self.innovations else { return None };
        let [least, most] = agreeing(count);
        let options = options(noises);
        if mean > most {
            let drift =
                if self.drift.is_some() { "" } else { ", let the drift of the odometry be learnt (--drift learnt)" };
            return Some(format!(
                "what was seen contradicts the noises that were told: the mean normalised innovation squared is {mean:.1} where 2 is \
                 expected and {most:.1} the most by chance, and {:.0} % are beyond the 99 % bound; tell larger noises ({options}){drift} or run \
                 more --particles",
                100.0 * beyond
            ));
        }
        // Where the filter chooses the landmark, it chooses what agrees.
        (mean < least && !self.unknown).then(|| {
            format!(
                "what was seen agrees far better than the noises that were told: the mean normalised innovation squared is {mean:.2} where 2 \
                 is expected and {least:.2} the least by chance; tell smaller noises ({options})"
            )
        })
    }

    fn of_landmarks(&self, noises: &[&str]) -> Option<String> {
        let Self { left, founded, there, .. } = *self;
        if there > 0.0 && left > 2.0 * there {
            return Some(format!(
                "the best map has {left} landmarks where {there} were seen: many are mapped twice; tell larger noises, or merge what coincides \
                 (--merge)"
            ));
        }
        let said = if there > 0.0 && left < 0.5 * there {
            format!("only {left} of the {there} landmarks that were seen are left in the best map")
        } else if there == 0.0 && founded >= 10.0 && left < LEAST_LEFT * founded {
            format!("only {left} of the {founded} landmarks that were mapped are left in the best map")
        } else {
            return None;
        };
        Some(format!(
            "{said}: the others were struck off because they were not seen where they should have been, or merged; let a sighting pay for more \
             misses (--sighting-worth, 0: nothing is struck off; --most-count), tell where the sensor truly sees (--max-range, --field-of-view) or \
             merge less (--merge); noises that are told too small do the same: tell larger ones ({})",
            options(noises)
        ))
    }

    fn of_stretches(&self) -> Option<String> {
        (self.blind > LONGEST_BLIND).then(|| {
            format!(
                "no landmark of the map was seen for {:.0} % of the steps on end: there the path is raw odometry, and landmarks may have gone or \
                 measurements be missing",
                100.0 * self.blind
            )
        })
    }

    fn of_errors(&self) -> Option<String> {
        let [online, odometry] = self.errors;
        if online > 1.1 * odometry {
            return Some(format!(
                "the filter errs by {online:.2} m where raw odometry errs by {odometry:.2} m: its landmarks lead it astray; look at units, signs \
                 and clocks of the log, or run more --particles"
            ));
        }
        // Where either is as good as a few ranges, there is little to win.
        if online < 3.0 * self.range_std {
            return None;
        }
        if online > HELPED * odometry {
            return Some(format!(
                "the filter errs by {online:.2} m where raw odometry errs by {odometry:.2} m: its landmarks hardly help; look at the noises that were told, and \
                 at units, signs and clocks of the log, or run more --particles"
            ));
        }
        (online > BEHIND * self.ekf).then(|| {
            format!(
                "the filter errs by {online:.2} m where EKF-SLAM that is told the same errs by {:.2} m: its particles are too few for loops as long as these; run \
                 more --particles or draw poses late (--late)",
                self.ekf
            )
        })
    }
}

/// The options that set the noise of the sensor and, by these names, of the odometry.
fn options(noises: &[&str]) -> String {
    let options: Vec<String> =
        ["range-std", "bearing-std"].iter().chain(noises).map(|name| format!("--{name}")).collect();
    options.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Outcome = Outcome {
        innovations: (900, Some(2.1), 0.012),
        unknown: true,
        drift: None,
        left: 18.0,
        founded: 57.0,
        there: 15.0,
        blind: 0.1,
        errors: [0.5, 2.4],
        ekf: 0.4,
        excess: 1.0,
        contradicting: 0.0,
        gone: 0.0,
        named: 1500.0,
        founded_again: 40.0,
        range_std: 0.3,
    };

    fn said(outcome: Outcome) -> String {
        outcome.remarks(&["alphas"]).join("\n")
    }

    #[test]
    fn of_a_run_that_agrees_nothing_is_said() {
        assert_eq!(said(GOOD), "");
        assert_eq!(said(Outcome { there: 0.0, ..GOOD }), "", "other robots were struck off");
        assert_eq!(said(Outcome { innovations: (0, None, 0.0), ..GOOD }), "");
        assert_eq!(said(Outcome { innovations: (3, Some(6.0), 0.3), ..GOOD }), "", "three say little");
        assert_eq!(
            said(Outcome { innovations: (900, Some(0.43), 0.0), unknown: false, ..GOOD }),
            "",
            "errors that repeat"
        );
    }

    #[test]
    fn innovations_that_contradict_the_noises_are_told_with_what_to_change() {
        let large = Outcome { innovations: (900, Some(18.4), 0.07), ..GOOD };
        let message = said(large);
        for part in
            ["18.4 where 2 is expected and 4.0", "7 % are", "--range-std, --bearing-std, --alphas", "--drift learnt"]
        {
            assert!(message.contains(part), "{message}");
        }
        assert!(!said(Outcome { drift: Some([0.0; 2]), ..large }).contains("--drift"));
        let small = Outcome { innovations: (900, Some(0.05), 0.0), unknown: false, ..GOOD };
        assert!(
            said(small).contains("0.05 where 2 is expected") && said(small).contains("smaller noises"),
            "{}",
            said(small)
        );
        assert_eq!(said(Outcome { unknown: true, ..small }), "");
    }

    #[test]
    fn looks_that_contradict_the_noises_are_told_where_innovations_agree() {
        let looks = said(Outcome { excess: 3.04, ..GOOD });
        assert!(
            looks.starts_with("successive measurements of what must be one landmark differ by 3.0 times"),
            "{looks}"
        );
        assert!(looks.ends_with("tell larger noises (--range-std, --bearing-std, --alphas)"), "{looks}");
        let both = said(Outcome { excess: 3.0, innovations: (900, Some(18.4), 0.07), ..GOOD });
        assert!(both.starts_with("what was seen contradicts") && !both.contains("successive"), "{both}");
    }

    #[test]
    fn landmarks_that_vanish_or_are_mapped_twice_are_told() {
        let few = Outcome { left: 8.0, there: 151.0, ..GOOD };
        assert!(said(few).starts_with("only 8 of the 151 landmarks that were seen are left"), "{}", said(few));
        let nameless = Outcome { left: 8.0, founded: 900.0, there: 0.0, ..GOOD };
        assert!(said(nameless).starts_with("only 8 of the 900 landmarks that were mapped"), "{}", said(nameless));
        assert!(
            said(nameless).ends_with("tell larger ones (--range-std, --bearing-std, --alphas)"),
            "{}",
            said(nameless)
        );
        let many = Outcome { left: 406.0, there: 151.0, ..GOOD };
        assert!(said(many).starts_with("the best map has 406 landmarks where 151 were seen"), "{}", said(many));
    }

    #[test]
    fn a_long_stretch_without_landmarks_and_a_filter_worse_than_odometry_are_told() {
        let blind = said(Outcome { blind: 0.5, ..GOOD });
        assert!(blind.starts_with("no landmark of the map was seen for 50 % of the steps on end"), "{blind}");
        let astray = said(Outcome { errors: [5.1, 4.4], ..GOOD });
        assert!(astray.starts_with("the filter errs by 5.10 m where raw odometry errs by 4.40 m"), "{astray}");
    }

    #[test]
    fn single_landmarks_that_contradict_or_have_gone_are_told() {
        let known = Outcome { unknown: false, ..GOOD };
        let some = said(Outcome { contradicting: 2.0, ..known });
        assert!(some.starts_with("what was seen of 2 of 15 landmarks contradicts"), "{some}");
        let all = said(Outcome { contradicting: 9.0, innovations: (900, Some(18.4), 0.07), ..known });
        assert!(all.starts_with("what was seen contradicts") && !all.contains("9 of 15"), "{all}");
        let gone = said(Outcome { gone: 7.0, ..known });
        assert!(gone.starts_with("7 of 15 landmarks were seen again and again and then no more"), "{gone}");
    }

    #[test]
    fn names_tell_how_well_features_were_told_apart_without_them() {
        let again = Outcome { founded_again: 160.0, ..GOOD };
        assert!(
            said(again).starts_with("160 observations of the 15 landmarks that were mapped already"),
            "{}",
            said(again)
        );
        assert_eq!(said(Outcome { named: 9000.0, ..again }), "", "in a long drive they are few");
        assert_eq!(said(Outcome { there: 0.0, ..again }), "", "without names nothing is known");
        assert_eq!(said(Outcome { unknown: false, ..again }), "");
    }

    #[test]
    fn a_filter_that_hardly_gains_on_its_odometry_is_told() {
        let little = said(Outcome { errors: [2.0, 2.4], ..GOOD });
        assert!(little.starts_with("the filter errs by 2.00 m") && little.contains("hardly help"), "{little}");
        assert_eq!(said(Outcome { errors: [0.5, 0.6], ..GOOD }), "", "little is to be won");
        let behind = said(Outcome { errors: [1.4, 9.0], ..GOOD });
        assert!(
            behind.contains("EKF-SLAM that is told the same errs by 0.40 m") && behind.contains("--late"),
            "{behind}"
        );
    }
}
