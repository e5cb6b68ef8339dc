//! States of the three filters that are worth trying.

use super::{model::ResamplingModel, recipe::SELECTIVE};
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::resampling as words,
};

/// N_eff of 16 that says that all is well.
const WELL: f64 = 15.0;

pub(super) fn challenges() -> Vec<Challenge<ResamplingModel>> {
    vec![
        Challenge::new("never", words::chip_never(), "threshold=0&step=90"),
        Challenge::new("always", words::chip_always(), "threshold=1&step=90"),
        Challenge::new("more", words::chip_more(), "particles=32&step=90"),
        Challenge::new("lose", words::chip_lose(), "wings=on&step=104").with(
            words::goal_lose(),
            "threshold odometry range scheme",
            lost_in_good_health,
        ),
    ]
}

/// Whether the selective filter lost the right wing up to the step shown, at a step at which its weights told of no harm.
fn lost_in_good_health(model: &ResamplingModel) -> Verdict {
    let lost = model.history(SELECTIVE).find(|moment| moment.report.right == Some(0));
    let Some(moment) = lost else { return Verdict::new(false, &[0.0], words::not_lost_yet().into()) };
    let said = words::ChipLost { step: &moment.report.step, ess: &fixed(moment.report.ess, 1) }.say();
    Verdict::new(moment.report.ess > WELL, &[moment.report.ess / WELL], said)
}
