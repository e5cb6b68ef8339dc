//! Decimal commas, in every figure.

use fastslam_widgets::{
    figure::Figure,
    numerals::in_text,
    registry::{self, FIGURES, VERSIONS},
    scene::Mark,
};

/// Words of one figure: picture, readouts, sentence, and what is said of its handles.
fn words(figure: &mut Figure) -> Vec<String> {
    let scene = figure.scene(800.0, 500.0);
    let written = scene.marks.into_iter().filter_map(|m| if let Mark::Text(t) = m { Some(t.text) } else { None });
    let handles = scene.handles.into_iter().map(|h| h.text);
    let readouts = figure.readouts().into_iter().map(|r| r.text);
    written.chain(handles).chain(readouts).chain([figure.describe()]).collect()
}

#[test]
fn every_number_of_every_figure_takes_a_comma_and_no_version_does() {
    let mut changed = 0;
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().seek(3);
        figure.model_mut().settle();
        let points = words(&mut figure);
        figure.set_decimal_comma(true);
        for (comma, point) in words(&mut figure).iter().zip(&points) {
            assert_eq!(comma, &in_text(point, Some(&VERSIONS)));
            assert!(!comma.contains("FastSLAM 1,0") && !comma.contains("FastSLAM 2,0"), "{comma}");
            changed += usize::from(comma != point);
        }
        assert!(!figure.query().contains(','), "links keep the point");
    }
    assert!(changed > 20, "{changed} texts changed");
}
