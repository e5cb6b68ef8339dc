//! Steps of a filter that two programs work out together: each draws for a part of the particles.

/// How many draws in a step are worth asking another program for half of them: of eight, the way there takes as long as four.
const DRAWS: usize = 12;

/// How many steps are worth having it begin.
const STEPS: u32 = 16;

/// Whether a run at its start, with so many draws in a step and steps to go, is to be shared.
pub fn is_worth_while(draws: usize, pending: u32) -> bool {
    draws >= DRAWS && pending >= STEPS
}

/// Draws with the step that they lead on from, ahead of them.
pub fn after(step: u32, draws: Vec<f64>) -> Vec<f64> {
    [vec![step.into()], draws].concat()
}

/// The draws of both parts, if they lead on from this step.
pub fn draws(parts: [&[f64]; 2], step: u32) -> Option<[&[f64]; 2]> {
    let [(first, a), (second, b)] = [parts[0].split_first()?, parts[1].split_first()?];
    (*first == f64::from(step) && first == second).then_some([a, b])
}

#[cfg(test)]
mod tests {
    use crate::{query, registry};

    /// Seen red where draws say nothing of their step.
    #[test]
    fn two_programs_that_draw_a_part_each_show_what_one_shows() {
        for (tag, link) in [
            ("fastslam-lap", "course=apartment&universes=16&step=40"),
            ("fastslam-resampling", "particles=40&threshold=0.6&step=40"),
        ] {
            let figure = || {
                let mut figure = registry::figure(tag).unwrap();
                assert_eq!(figure.model_mut().configure(&query::pairs(link)), []);
                figure
            };
            let [mut page, mut partner, mut alone] = [figure(), figure(), figure()];
            assert!(page.shares() && partner.shares(), "{tag}");
            let mut late = Vec::new();
            while page.pending() {
                let [mine, theirs] = [page.part(0), partner.part(1)];
                partner.work_with([&mine, &theirs]);
                // What comes a step too late, or from nowhere, is not believed.
                let step = page.model().step();
                let given = if step == 7 { &late } else { &theirs };
                page.work_with([&mine, if step == 9 { &[] } else { given }]);
                late = theirs;
            }
            assert!(!page.shares() && !partner.pending(), "{tag}");
            alone.model_mut().settle();
            for figure in [&mut page, &mut partner, &mut alone] {
                figure.paint(600, 400, 1.0, crate::paint::Theme::Light);
            }
            let shown = |figure: &crate::figure::Figure| serde_json::to_string(&figure.export()).unwrap();
            assert!(shown(&page) == shown(&alone), "{tag}");
            assert!(shown(&partner) == shown(&alone), "{tag}");
            assert!(page.canvas().pixels() == alone.canvas().pixels(), "{tag}");
        }
    }

    #[test]
    fn a_few_universes_are_not_worth_the_way_nor_are_landmarks() {
        for (tag, link) in [
            ("fastslam-lap", "course=apartment&universes=8&step=90"),
            ("fastslam-resampling", "wings=on&particles=64&step=60"),
            ("fastslam-proposal", ""),
        ] {
            let mut figure = registry::figure(tag).unwrap();
            assert_eq!(figure.model_mut().configure(&query::pairs(link)), []);
            assert!(!figure.shares(), "{tag}");
        }
    }
}
