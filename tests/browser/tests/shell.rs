//! The shell as the page sees it, in a browser.
#![cfg(target_arch = "wasm32")]

use fastslam_widgets::shell::{Figure, tags};
use js_sys::{JSON, Object, Reflect};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

fn get(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).expect("a property")
}

fn text(object: &JsValue, name: &str) -> String {
    get(object, name).as_string().expect("a string")
}

fn figure(query: &str) -> Figure {
    let mut figure = Figure::new("fastslam-lap").unwrap_or_else(|_| panic!("a tag of the registry"));
    assert!(figure.load(query).is_empty(), "{query}");
    settle(&mut figure);
    figure
}

fn settle(figure: &mut Figure) {
    while figure.pending() > 0 {
        figure.work();
    }
}

#[wasm_bindgen_test]
fn parameters_values_and_readouts_are_plain_objects() {
    assert_eq!(tags()[0], "fastslam-lap");
    let figure = figure("universes=2&step=1");
    let params = figure.params();
    assert_eq!(text(&params.get(0), "name"), "universes");
    assert_eq!(text(&params.get(0), "kind"), "integer");
    assert_eq!(text(&params.get(0), "default"), "16");
    assert_eq!(get(&params.get(0), "max").as_f64(), Some(256.0));
    let values: JsValue = figure.values().into();
    // Only a text, as a plan that nobody has drawn, may be empty.
    assert!(
        params.iter().all(|param| text(&param, "kind") == "text" || !text(&values, &text(&param, "name")).is_empty())
    );
    assert_eq!(Object::keys(values.unchecked_ref::<Object>()).length(), params.length());
    let readout = figure.readouts().get(1);
    assert!(get(&readout, "value").as_f64().is_some());
    assert_eq!(text(&readout, "unit"), "m");
}

#[wasm_bindgen_test]
fn errors_are_thrown_with_the_name_of_their_parameter() {
    assert!(Figure::new("no-such-tag").is_err());
    let mut figure = figure("universes=2");
    let error: JsValue = figure.set("range-std", "0.5").expect_err("out of range").into();
    assert!(error.is_instance_of::<js_sys::Error>());
    assert_eq!(text(&error, "name"), "FigureError");
    assert_eq!(text(&error, "parameter"), "range-std");
    assert!(text(&error, "message").contains("from 0.01 to 0.3 m"), "{}", text(&error, "message"));
    assert_eq!(figure.load("v=9&range-std=7&seed=4").len(), 1);
    assert_eq!(figure.query(), "v=9&seed=4");
}

#[wasm_bindgen_test]
fn data_parses() {
    let figure = figure("v=9&universes=2&step=3");
    let data = JSON::parse(&figure.json()).expect("JSON");
    assert_eq!(text(&data, "query"), "v=9&universes=2&step=3");
    assert_eq!(get(&get(&data, "steps"), "length").as_f64(), Some(4.0));
    assert!(figure.csv().starts_with("step,"));
}

#[wasm_bindgen_test]
fn figures_do_not_touch_each_other() {
    let alone = figure("universes=3&step=4").csv();
    let mut one = figure("universes=3&step=2");
    let mut other = figure("universes=6&seed=9&step=4");
    other.paint(300, 200, 1.0, "dark");
    one.seek(4);
    settle(&mut one);
    drop(other);
    assert_eq!(one.csv(), alone);
}
