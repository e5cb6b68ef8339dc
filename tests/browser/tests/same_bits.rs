//! What the native build computed, computed again in the browser: the same bits of every trace, every readout, every pixel and
//! the chapter's numbers. The goldens are written natively, by `tests/portability`, `tests/figures` and `npm run numbers`.
#![cfg(target_arch = "wasm32")]

use core::hash::Hasher as _;
use fastslam::execute::Executor;
use fastslam_lab::{digest::Digest, experiment::golden};
use fastslam_widgets::shell::{Figure, job};
use figures::{JOBS, LOG, PICTURES, Picture, SETUPS, TINY_LOG, line, put_readout, rows};
use js_sys::{Array, JSON, Reflect, Uint8Array, WebAssembly};
use portability::{Extent, assert_fresh, remake};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

// In a worker: a lap takes seconds, and a page that is busy for so long does not answer the driver, which gives up after thirty.
wasm_bindgen_test_configure!(run_in_dedicated_worker);

const TRACES: &str = include_str!("../../portability/golden.txt");
const READOUTS: &str = include_str!("../../figures/golden/readouts.txt");
const ROWS: &str = include_str!("../../figures/golden/jobs.txt");
const PIXELS: &str = include_str!("../../figures/golden/pixels.txt");

/// Compares line by line, so that a failure names what differs.
fn same_lines(computed: &[String], golden: &str) {
    for (line, golden) in computed.iter().zip(golden.lines()) {
        assert_eq!(line.trim_end(), golden);
    }
    assert_eq!(computed.len(), golden.lines().count());
}

fn get(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).expect("a property")
}

fn text(object: &JsValue, name: &str) -> String {
    get(object, name).as_string().expect("a string")
}

/// A figure in the state of a link, through the calls that the page makes.
fn figure(tag: &str, query: &str) -> Figure {
    let mut figure = Figure::new(tag).unwrap_or_else(|_| panic!("no figure {tag}"));
    // A link of before is told what has changed since, in a line for each change.
    let said = act(&mut figure, &format!(r#"{{"do":"begin","value":"{query}"}}"#)).get(0);
    assert!(text(&said, "message").lines().all(|said| said.contains("an earlier version")), "{query}");
    if tag == LOG {
        assert!(figure.open(TINY_LOG).is_ok());
        seek(&mut figure, u32::MAX);
    }
    settle(&mut figure);
    figure
}

fn settle(figure: &mut Figure) {
    while figure.pending() {
        figure.work();
    }
}

fn act(figure: &mut Figure, action: &str) -> Array {
    figure.act(JSON::parse(action).expect("JSON").unchecked_ref()).expect("an action")
}

fn seek(figure: &mut Figure, step: u32) {
    act(figure, &format!(r#"{{"do":"seek","at":[{step}]}}"#));
}

/// A frame, for a canvas of this width \[css px\] and these pixels.
fn frame(figure: &mut Figure, width: f64, theme: &str, [w, h]: [u32; 2]) -> JsValue {
    act(figure, &format!(r#"{{"do":"size","name":"{theme}","at":[{width},1e9,1,{width},{w},{h}]}}"#));
    figure.frame(false).into()
}

/// The pixels as the page gets them: a view of the module's memory.
fn pixels(figure: &Figure, [width, height]: [u32; 2]) -> Vec<u8> {
    let mut pixels = vec![0; 4 * (width * height) as usize]; // first: memory that grows leaves its views behind
    let memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
    Uint8Array::new_with_byte_offset_and_length(&memory.buffer(), figure.pixels(), 4 * width * height)
        .copy_to(&mut pixels);
    pixels
}

/// This build has `parallel` and `single-threaded` both on, so all that follows is computed as on a page whose dependencies asked for threads.
#[wasm_bindgen_test]
fn single_threaded_wins_where_threads_are_compiled_in() {
    let _compiled_in = Executor::Rayon;
    assert!(matches!(Executor::default(), Executor::Serial), "{:?}", Executor::default());
}

#[wasm_bindgen_test]
fn whole_runs_leave_the_traces_of_the_native_build() {
    let traces = golden::traces(&Executor::default()).into_iter().map(|(name, digest)| line(name, &digest));
    same_lines(&traces.collect::<Vec<_>>(), TRACES);
}

#[wasm_bindgen_test]
fn every_readout_of_every_step_has_the_bits_of_the_native_build() {
    let readouts = SETUPS.iter().map(|(tag, query)| {
        let mut figure = figure(tag, query);
        let mut digest = Digest::new();
        let mut readouts = Array::new();
        for step in 0..=get(&figure.state(), "last").as_f64().expect("a step") as u32 {
            seek(&mut figure, step);
            settle(&mut figure);
            let frame: JsValue = figure.frame(false).into();
            // Those that are not told are as they were.
            if let Ok(changed) = get(&get(&frame, "news"), "readouts").dyn_into() {
                readouts = changed;
            }
            for readout in readouts.iter() {
                put_readout(
                    &mut digest,
                    &text(&readout, "name"),
                    get(&readout, "value").as_f64(),
                    &text(&readout, "text"),
                );
            }
            digest.write(text(&frame, "sentence").as_bytes());
        }
        line(&format!("{tag}?{query}"), &digest)
    });
    same_lines(&readouts.collect::<Vec<_>>(), READOUTS);
}

#[wasm_bindgen_test]
fn every_golden_picture_has_the_pixels_of_the_native_build() {
    let mut lines = Vec::new();
    for state in PICTURES.chunk_by(Picture::is_of_the_state_of) {
        let mut figure = figure(state[0].tag, state[0].query);
        for picture in state {
            let width = f64::from(picture.width);
            let unpainted = frame(&mut figure, width, picture.theme, [0, 0]);
            let size = picture.size(get(&get(&unpainted, "layout"), "height").as_f64().expect("a height"));
            frame(&mut figure, width, picture.theme, size);
            let mut digest = Digest::new();
            digest.write(&pixels(&figure, size));
            lines.push(picture.line(&digest));
        }
    }
    same_lines(&lines, PIXELS);
}

#[wasm_bindgen_test]
fn every_job_gives_the_rows_of_the_native_build() {
    let jobs = JOBS.iter().map(|(name, query, [from, to])| {
        let found = job(name, query, *from, *to).unwrap_or_else(|_| panic!("{name}?{query}"));
        let numbers = found.iter().flat_map(|row| row.unchecked_into::<Array>().iter().collect::<Vec<_>>());
        line(&format!("{name}?{query}"), &rows(numbers.filter_map(|x| x.as_f64())))
    });
    same_lines(&jobs.collect::<Vec<_>>(), ROWS);
}

#[wasm_bindgen_test]
fn the_chapter_s_numbers_are_those_of_the_native_build() {
    assert_fresh(&remake(&Executor::default(), Extent::Groups));
}

#[wasm_bindgen_test]
#[ignore = "breadth: all seeds"]
fn the_chapter_s_numbers_by_all_their_seeds_are_those_of_the_native_build() {
    assert_fresh(&remake(&Executor::default(), Extent::AllSeeds));
}
