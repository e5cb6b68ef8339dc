use super::*;
use crate::model::Tells as _;

fn at(step: u32) -> UniversesModel {
    let mut model = UniversesModel::default();
    model.seek(step);
    model
}

#[test]
fn laps_come_one_by_one_in_an_order_that_is_mixed_and_at_the_end_all_have_come_once() {
    let (mut before, end) = (at(0).fractions(ProposalKind::Motion), at(LAST).fractions(ProposalKind::Motion));
    for step in 1..=LAST {
        let now = at(step).fractions(ProposalKind::Motion);
        for (before, now) in before.iter().zip(&now) {
            assert_eq!(now.total, before.total + 1);
            assert!([0, 1].contains(&(now.successes - before.successes)));
        }
        before = now;
    }
    for (rank, whole) in end.into_iter().enumerate() {
        let well = shipped::MOTION[rank].iter().filter(|error| f64::from(**error) < 1000.0 * 0.5).count();
        assert_eq!((whole.successes as usize, whole.total as usize), (well, LAPS), "M = {}", TRIED[rank]);
        // In sorted order all that end well would come first.
        let half = at(99).fractions(ProposalKind::Motion)[rank];
        let [low, high] = half.wilson();
        assert!((low - 0.05..=high + 0.05).contains(&whole.share()), "M = {}: {half:?} of {whole:?}", TRIED[rank]);
    }
}

#[test]
fn few_laps_say_so_and_a_question_shows_none() {
    assert!(at(11).narrate().starts_with("12 laps of each M."), "{}", at(11).narrate());
    assert!(at(0).narrate().starts_with("1 lap of each M."), "{}", at(0).narrate());
    assert!(at(11).describe().contains("of 12 laps") && at(LAST).describe().contains("of 200 laps"));
    let mut asked = at(11);
    asked.change(|recipe| recipe.prediction.predict = true);
    assert_eq!((asked.step_count(), asked.step()), (0, 0));
}
