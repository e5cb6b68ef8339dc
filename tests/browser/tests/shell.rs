//! The shell as the page sees it, in a browser.
#![cfg(target_arch = "wasm32")]

use fastslam_widgets::shell::Figure;
use js_sys::{Array, JSON, Object, Reflect};
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
    assert_eq!(refused(&mut figure, &load(query)), Vec::<String>::new(), "{query}");
    settle(&mut figure);
    figure
}

fn settle(figure: &mut Figure) {
    while figure.pending() {
        figure.work();
    }
}

fn load(query: &str) -> String {
    format!(r#"{{"do":"begin","value":"{query}"}}"#)
}

/// What the page asks, written as JSON.
fn object(action: &str) -> Object {
    JSON::parse(action).expect("JSON").unchecked_into()
}

/// Asks for something, as the page does, and returns what is refused of it.
fn refused(figure: &mut Figure, action: &str) -> Vec<String> {
    let said = figure.act(&object(action)).expect("an action");
    said.iter().map(|said| text(&said, "message")).filter(|message| !message.is_empty()).collect()
}

#[wasm_bindgen_test]
fn parameters_values_and_readouts_are_plain_objects() {
    let mut figure = figure("universes=2&step=1");
    let news = get(&figure.frame(false), "news");
    let params: Array = get(&news, "specs").unchecked_into();
    assert_eq!(text(&params.get(0), "name"), "universes");
    assert_eq!(text(&params.get(0), "kind"), "integer");
    assert_eq!(text(&params.get(0), "default"), "16");
    assert_eq!(get(&params.get(0), "max").as_f64(), Some(256.0));
    let values = get(&figure.state(), "values");
    // Only a text, as a plan that nobody has drawn, may be empty.
    assert!(
        params.iter().all(|param| text(&param, "kind") == "text" || !text(&values, &text(&param, "name")).is_empty())
    );
    assert_eq!(Object::keys(values.unchecked_ref::<Object>()).length(), params.length());
    let readout = get(&news, "readouts").unchecked_into::<Array>().get(1);
    assert!(get(&readout, "value").as_f64().is_some());
    assert_eq!(text(&readout, "unit"), "m");
    // What has not changed does not come again.
    assert_eq!(Object::keys(get(&figure.frame(false), "news").unchecked_ref::<Object>()).length(), 0);
}

#[wasm_bindgen_test]
fn what_is_refused_names_its_parameter_and_what_is_no_action_is_thrown() {
    let error: JsValue = Figure::new("no-such-tag").err().expect("no figure").into();
    assert!(error.is_instance_of::<js_sys::Error>());
    assert_eq!((text(&error, "name"), text(&error, "parameter")), ("FigureError".into(), "tag".into()));
    let mut figure = figure("universes=2");
    let set = object(r#"{"do":"set","name":"range-std","value":"0.5"}"#);
    let said = figure.act(&set).expect("an action").get(0);
    assert_eq!(text(&said, "parameter"), "range-std");
    assert!(text(&said, "message").contains("from 0.01 to 0.3 m"), "{}", text(&said, "message"));
    assert_eq!(refused(&mut figure, &load("v=13&range-std=7&seed=4")).len(), 1);
    assert_eq!(text(&figure.state(), "query"), "v=13&seed=4");
    assert!(figure.act(&object(r#"{"do":"sett"}"#)).is_err());
}

#[wasm_bindgen_test]
fn data_has_a_row_for_each_step() {
    let data = figure("v=13&universes=2&step=3").export();
    assert_eq!(text(&data, "query"), "v=13&universes=2&step=3");
    assert_eq!(get(&get(&data, "steps"), "length").as_f64(), Some(4.0));
}

#[wasm_bindgen_test]
fn figures_do_not_touch_each_other() {
    let data = |figure: &Figure| String::from(JSON::stringify(&figure.export()).expect("JSON"));
    let alone = data(&figure("universes=3&step=4"));
    let mut one = figure("universes=3&step=2");
    let mut other = figure("universes=6&seed=9&step=4");
    refused(&mut other, r#"{"do":"size","name":"dark","at":[300,200,1,300,300,200]}"#);
    assert_eq!(get(&get(&other.frame(false), "layout"), "scale").as_f64(), Some(1.0));
    refused(&mut one, r#"{"do":"set","name":"step","value":"4"}"#);
    settle(&mut one);
    drop(other);
    assert_eq!(data(&one), alone);
}
