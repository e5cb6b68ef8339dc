//! What the laws of all figures share: a figure by its public face, as a page has it.

use fastslam_widgets::{
    figure::Figure,
    scene::{Mark, Rect, Scene},
};

/// The figure of a tag in the state that a link names, simulated. The link may be of an earlier version.
pub fn figure(tag: &str, query: &str) -> Figure {
    let mut figure = Figure::new(tag).unwrap();
    let said = figure.load(query);
    assert!(said.iter().all(|remark| remark.parameter == "v"), "{query}: {said:?}");
    figure.model_mut().settle();
    figure
}

/// What is to be seen at this width, in the height that the figure wants.
pub fn scene(figure: &Figure, width: f64) -> Scene {
    figure.scene(width, figure.height(width))
}

/// Everything a reader gets from a state, for comparing two ways to it.
pub fn state(figure: &Figure) -> (String, Vec<String>, Scene) {
    let readouts = figure.model().readouts().iter().map(|r| format!("{r:?} {:?}", r.value.map(f64::to_bits))).collect();
    (figure.query(), readouts, scene(figure, 800.0))
}

/// That every text lies in its box and the figure, whole, and over no other. Returns where there is ink.
pub fn assert_texts_fit(scene: &Scene, which: &str) -> Vec<Rect> {
    let bounds = Rect::new(0.0, 0.0, scene.width, scene.height);
    let mut inked: Vec<(Rect, &str)> = Vec::new();
    for mark in &scene.marks {
        let Mark::Text(text) = mark else { continue };
        assert!(text.width() <= text.area.w + 1e-9 && text.size <= text.area.h, "{which}: {text:?}");
        assert!(bounds.encloses(&text.area), "{which}: {text:?}");
        assert!(!text.text.ends_with('…'), "{which}: {text:?} was shortened");
        let [x, y] = text.origin();
        // Parts of a formula follow each other: where one ends the next begins, but for rounding.
        let ink = Rect::new(x, y - 0.7 * text.size, text.width() - 1e-6, 0.7 * text.size);
        for (other, words) in &inked {
            // A hat stands over its letter: its ink is the upper part of its box.
            let hat = ["^", "~"].contains(&text.text.as_str()) && words.ends_with(['z', 'w']);
            assert!(hat || !ink.overlaps(other), "{which}: {:?} covers {words:?}", text.text);
        }
        inked.push((ink, &text.text));
    }
    inked.into_iter().map(|(ink, _)| ink).collect()
}

/// That every mark but the texts, for which there is [`assert_texts_fit`], lies in the figure.
pub fn assert_drawn_inside(scene: &Scene, which: &str) {
    let bounds = Rect::new(0.0, 0.0, scene.width, scene.height);
    for mark in &scene.marks {
        let points: Vec<_> = match mark {
            Mark::Lines { lines, .. } => lines.iter().flatten().copied().collect(),
            Mark::Polygons { polygons, .. } => polygons.iter().flatten().copied().collect(),
            Mark::Discs { centres, .. } => centres.clone(),
            Mark::Raster { area, .. } | Mark::Fill { area, .. } | Mark::Frame { area, .. } => {
                assert!(bounds.encloses(area), "{which}: {mark:?}");
                continue;
            }
            Mark::Text(_) => continue,
        };
        let outside = points.iter().find(|p| !bounds.encloses(&Rect::new(p[0], p[1], 0.0, 0.0)));
        assert_eq!(outside, None, "{which}");
    }
}
