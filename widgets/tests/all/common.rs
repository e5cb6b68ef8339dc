//! What the laws of all figures share: a figure by its public face, as a page has it.

use fastslam_widgets::{
    figure::Figure,
    registry,
    scene::{Mark, Rect, Scene},
};

/// The figure of a tag in the state that a link names, simulated. The link may be of an earlier version.
pub fn figure(tag: &str, query: &str) -> Figure {
    let mut figure = registry::figure(tag).unwrap();
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

/// Where texts have ink, and what is wrong with them: every one lies in its box and the figure, whole, and over no other.
pub fn texts(scene: &Scene) -> (Vec<Rect>, Vec<String>) {
    let bounds = Rect::new(0.0, 0.0, scene.width, scene.height);
    let (mut inked, mut wrong): (Vec<(Rect, &str)>, Vec<String>) = (Vec::new(), Vec::new());
    for mark in &scene.marks {
        let Mark::Text(text) = mark else { continue };
        let words = text.text.as_str();
        // A decimal comma may be wider than the point that the box was measured for.
        if text.width() > text.area.w + 0.5 || text.size > text.area.h {
            wrong.push(format!("{words:?} is larger than its box"));
        }
        if !bounds.encloses(&text.area) {
            wrong.push(format!("{words:?} goes beyond the figure"));
        }
        if words.ends_with('…') || words.is_empty() {
            wrong.push(format!("{words:?} was shortened"));
        }
        let [x, y] = text.origin();
        // Parts of a formula follow each other: where one ends the next begins, but for rounding.
        let ink = Rect::new(x, y - 0.7 * text.size, text.width() - 1e-6, 0.7 * text.size);
        // A hat stands over its letter: its ink is the upper part of its box.
        let hat = |other: &str| ["^", "~"].contains(&words) && other.ends_with(['z', 'w']);
        let covered = inked.iter().filter(|(other, under)| ink.overlaps(other) && !hat(under));
        wrong.extend(covered.map(|(_, under)| format!("{words:?} covers {under:?}")));
        inked.push((ink, words));
    }
    (inked.into_iter().map(|(ink, _)| ink).collect(), wrong)
}

/// That nothing is wrong with the texts. Returns where there is ink.
pub fn assert_texts_fit(scene: &Scene, which: &str) -> Vec<Rect> {
    let (inked, wrong) = texts(scene);
    assert!(wrong.is_empty(), "{which}: {}", wrong.join("; "));
    inked
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
