use super::*;
use crate::field;
use strum::{Display, VariantArray};

#[derive(Clone, Copy, PartialEq, Debug, Display, VariantArray)]
#[strum(serialize_all = "lowercase")]
enum Scheme {
    Systematic,
    Stratified,
    Multinomial,
    Residual,
}

#[derive(Clone, PartialEq, Debug)]
struct Trip {
    last: u32,
    step: u32,
    chosen: Option<u32>,
    speed: f64,
    scheme: Scheme,
    back: bool,
}

impl Default for Trip {
    fn default() -> Self {
        Self { last: 8, step: 5, chosen: None, speed: 0.3, scheme: Scheme::Stratified, back: true }
    }
}

impl Recipe for Trip {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Trip>;
        vec![
            P::integer("last", "Last step", "", (1, 9), field!(last), ""),
            P::integer("step", "Step", "", (0, 0), field!(step), "").at_most(|trip| trip.last.into()).view(),
            P::integer_or("chosen", "Chosen", ("all", "all"), |trip| trip.last.into(), field!(chosen), ""),
            P::number("speed", "Speed", "m/s", (0.1 + 0.2, 1.0, 0.1), field!(speed), "").without_slider(),
            P::choice("scheme", "Scheme", Menu::of(Scheme::Stratified, |_| "a scheme"), field!(scheme), ""),
            P::toggle("back", "Back", field!(back), ""),
        ]
    }

    fn refuse(&mut self, before: &Self) -> Vec<FigureError> {
        if self.speed < 1.0 || self.back {
            return Vec::new();
        }
        self.back = before.back;
        vec![FigureError::new("back", "off", "on at full speed")]
    }
}

fn given(values: &[(&str, &str)]) -> (Trip, Vec<FigureError>) {
    let values: Vec<_> = values.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect();
    with(&Trip::default(), &values)
}

#[test]
fn every_default_is_the_recipe_s_own_and_a_value_that_is_taken() {
    let defaults: Vec<String> = specs(&Trip::default()).into_iter().map(|spec| spec.default).collect();
    assert_eq!(defaults, ["8", "5", "all", "0.3", "stratified", "on"]);
    for ((spec, default), value) in specs(&Trip::default()).iter().zip(&defaults).zip(values(&Trip::default())) {
        assert_eq!(value, (spec.name, default.clone()));
        assert!(spec.check(default).is_ok(), "{}", spec.name);
    }
}

#[test]
fn a_row_finds_the_rows_above_it_as_they_will_be_whatever_the_order() {
    let (trip, refused) = given(&[("chosen", "9"), ("step", "9"), ("last", "9")]);
    assert_eq!((trip.step, trip.chosen, refused.len()), (9, Some(9), 0));
    let (trip, refused) = given(&[("chosen", "5"), ("step", "4"), ("last", "3")]);
    assert_eq!((trip.step, trip.chosen), (3, None), "what was there is brought into its range");
    let said: Vec<&str> = refused.iter().map(|error| error.message.as_str()).collect();
    assert_eq!(
        said,
        [
            "step = \"4\": must be a whole number from 0 to 3",
            "chosen = \"5\": must be all or a whole number from -1 to 3"
        ]
    );
    assert_eq!(given(&[("chosen", "-1")]).0.chosen, None);
}

#[test]
fn what_is_refused_and_what_is_unknown_changes_nothing_else() {
    let (trip, refused) = given(&[("colour", "red"), ("speed", "0.29"), ("scheme", "residual"), ("speed", "x")]);
    assert_eq!(trip, Trip { scheme: Scheme::Residual, ..Trip::default() });
    assert_eq!(refused.iter().map(|e| e.parameter.as_str()).collect::<Vec<_>>(), ["speed", "speed", "colour"]);
    assert!(refused[2].message.contains("it has last, step, chosen"), "{}", refused[2]);
    let (trip, refused) = given(&[("back", "off"), ("speed", "1")]);
    assert_eq!((trip.back, trip.speed, refused.len()), (true, 1.0, 1), "together they are refused");
}

#[test]
fn the_words_of_an_enum_are_its_own_and_the_default_stands_first() {
    let scheme = &specs(&Trip::default())[4];
    let words: Vec<&str> = scheme.choices.iter().map(|choice| choice.value.as_str()).collect();
    assert_eq!(words, ["stratified", "systematic", "multinomial", "residual"]);
    let menu = Menu::of(Scheme::Systematic, |_| "").after(("usual", "usual", None), Some);
    assert_eq!((menu.choices.len(), menu.choices[0].value.as_str(), menu.meanings[0]), (5, "usual", None));
}

#[test]
fn numbers_set_by_hand_end_in_their_ranges() {
    let trip = Trip { last: 99, step: 12, chosen: Some(10), speed: 7.0, ..Trip::default() };
    let trip = confined(trip);
    assert_eq!((trip.last, trip.step, trip.chosen, trip.speed), (9, 9, None, 1.0));
    assert_eq!(confined(Trip { speed: 0.0, ..trip }).speed, 0.3, "and not a little beside a decimal");
}
