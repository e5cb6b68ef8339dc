//! The share of laps that end well over M, and beside it, on the same levels, what the rule makes of such a share.

use super::{
    layout::{Layout, Part, SCALE},
    model::{PROPOSALS, UniversesModel},
    recipe::{LAST, MOST, nearest},
    told::{asked, name, percent},
};
use crate::{
    decimal::write,
    marks::Place,
    model::{Declared, Model},
    scene::{Chart, Handle, Letters, Point, Rect, Role, Sample, Scene, legend, plain, strong},
    words::universes as words,
};
use fastslam::ops;
use fastslam_lab::experiment::{
    Fraction, ProposalKind,
    universes::{ENOUGH, TRIED},
};

/// The number of universes that is read.
pub const UNIVERSES: &str = "universes";

/// Font size of what is written at the charts \[css px\].
pub const SIZE: f64 = 11.5;

/// Numbers of universes with a name on the axis.
const TICKS: [usize; 6] = [1, 2, 4, 8, 16, 40];

/// The name of a place.
const TICK: Letters = plain(11.0, Role::Muted).middle();

/// Between the lines of a band \[css px\].
const HATCH: f64 = 3.0;

/// Dash of the level that is asked for.
pub const LEVEL: [f64; 2] = [5.0, 3.0];

/// Places of the operating curve.
const PLACES: u32 = 50;

/// How a proposal is drawn.
pub fn role(proposal: ProposalKind) -> Role {
    match proposal {
        ProposalKind::Motion => Role::Prior,
        ProposalKind::Improved => Role::Posterior,
    }
}

/// Where a number of universes is \[css px\]: twice is as far everywhere.
pub fn x(area: &Rect, universes: f64) -> f64 {
    area.x + area.w * ops::ln(universes.clamp(1.0, MOST.into())) / ops::ln(MOST.into())
}

/// The number of universes at a place \[css px\].
pub fn universes(area: &Rect, x: f64) -> f64 {
    ops::exp(((x - area.x) / area.w).clamp(0.0, 1.0) * ops::ln(MOST.into()))
}

/// A chart of shares.
pub fn chart(part: &Part) -> Chart {
    Chart { area: part.area, last: 0 }
}

/// Edges, the level that is asked for, and names of levels where there is room for them.
#[inline(never)]
pub fn frame(scene: &mut Scene, part: &Part, levels: &[(f64, Role)]) {
    let (chart, x) = (chart(part), part.area.x);
    chart.edges(scene);
    if part.area.x - part.header.x < SCALE {
        return;
    }
    for (level, role) in levels {
        let y = chart.y(*level);
        let place = Rect::new(x - SCALE, y - 7.0, SCALE - 5.0, 14.0);
        scene.text(place, plain(11.0, *role).end(), &format!("{} %", percent(*level)));
        chart.rule(scene, y);
    }
}

/// Names of places below a chart, and what they are.
#[inline(never)]
pub fn axis(scene: &mut Scene, part: &Part, names: &[(f64, String)], what: [String; 2]) {
    for &(x, ref name) in names {
        scene.line(&[[x, part.area.bottom()], [x, part.area.bottom() + 4.0]], 1.0, Role::Muted);
        // Around its place, and inside of the part.
        let w = TICK.width(name) + 1.0;
        let left = (x - 0.5 * w).min(part.ticks.right() - w).max(part.ticks.x);
        let place = Rect::new(left, part.ticks.y + 4.0, w, part.ticks.h - 4.0);
        scene.text(place, TICK, name);
    }
    let place = Rect { x: part.area.x, w: part.axis.right() - part.area.x, ..part.axis };
    scene.fit(place, plain(SIZE, Role::Muted), &what);
}

/// Shares over M.
pub fn share(scene: &mut Scene, model: &UniversesModel, part: &Part, taken: &mut Vec<Rect>) {
    let (recipe, area, chart) = (model.recipe(), part.area, chart(part));
    let threshold = &write(recipe.threshold);
    let title = [words::Share { threshold, n: &model.laps() }.say(), words::ShareShort { threshold }.say()];
    let title = if recipe.prediction.predict { asked(model) } else { title };
    scene.fit(part.header, strong(SIZE, Role::Ink), &title);
    let shown = || PROPOSALS.into_iter().filter(|proposal| recipe.shows(*proposal));
    let dotted = |role| {
        Sample::new(move |scene, place| {
            Sample::line(role, 2.0, None).draw(scene, place);
            scene.disc(place.centre(), 3.0, role);
        })
    };
    let items = shown().map(|proposal| (dotted(role(proposal)), name(proposal)));
    let band = (Sample::new(|scene, place| hatched(scene, place, Role::Muted)), words::interval());
    let enough = (Sample::line(Role::Accent, 1.5, Some(LEVEL)), words::four_fifths());
    legend(scene, &part.legend, items.chain([enough, band]));

    frame(scene, part, &[(0.0, Role::Muted), (0.5, Role::Muted), (1.0, Role::Muted)]);
    let ticks = TICKS.map(|universes| (x(&area, universes as f64), universes.to_string()));
    axis(scene, part, &ticks, [words::axis_universes().into(), words::axis_universes_short().into()]);
    scene.dash(&chart.level(ENOUGH), 1.5, LEVEL, Role::Accent);
    if model.hides() {
        return;
    }
    for proposal in shown() {
        let fractions = model.fractions(proposal);
        band_of(scene, &chart, &fractions, role(proposal));
    }
    for proposal in shown() {
        let fractions = model.fractions(proposal);
        let points: Vec<Point> = points(&chart, &fractions, Fraction::share).collect();
        scene.line(&points, 2.0, role(proposal));
        scene.discs(points, 3.0, role(proposal));
    }
    // The newest laps, up where they end well and down where they do not: the points go there.
    for proposal in shown().filter(|_| model.step() < LAST) {
        let place = |(rank, m): (usize, &usize)| {
            let well = model.ends(proposal, rank).next_back() == Some(true);
            [x(&area, *m as f64), chart.y(f64::from(u8::from(well)))]
        };
        scene.discs(TRIED.iter().enumerate().map(place).collect(), 5.0, role(proposal));
    }
    for proposal in shown() {
        needs(scene, model, &chart, proposal, taken);
    }
    // Of the one that has more to gain, if both have enough.
    if let Some(of) = shown().find(|proposal| model.saturated(*proposal).is_some()) {
        nothing_more(scene, model, &chart, of, taken);
    }
}

fn points<'a>(
    chart: &'a Chart,
    fractions: &'a [Fraction],
    of: impl Fn(&Fraction) -> f64 + 'a,
) -> impl Iterator<Item = Point> + 'a {
    TRIED.iter().zip(fractions).map(move |(m, fraction)| [x(&chart.area, *m as f64), chart.y(of(fraction))])
}

/// The 95 % intervals, hatched.
fn band_of(scene: &mut Scene, chart: &Chart, fractions: &[Fraction], role: Role) {
    let [low, high] = [0, 1].map(|end| points(chart, fractions, move |fraction| fraction.wilson()[end]).collect());
    let at = |line: &Vec<Point>, x: f64| {
        let k = line.partition_point(|point| point[0] < x).clamp(1, line.len() - 1);
        let ([x0, y0], [x1, y1]) = (line[k - 1], line[k]);
        y0 + (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
    };
    let count = (chart.area.w / HATCH) as u32;
    let places = (0..=count).map(|k| chart.area.x + HATCH * f64::from(k));
    scene.lines(places.map(|x| vec![[x, at(&low, x)], [x, at(&high, x)]]).collect(), 0.75, role);
}

fn hatched(scene: &mut Scene, place: &Rect, role: Role) {
    let count = (place.w / HATCH) as u32;
    let lines = (0..=count)
        .map(|k| place.x + HATCH * f64::from(k))
        .map(|x| vec![[x, place.y + 1.0], [x, place.bottom() - 1.0]]);
    scene.lines(lines.collect(), 0.75, role);
}

/// The smallest number that is enough, at the lower edge below its dot.
fn needs(scene: &mut Scene, model: &UniversesModel, chart: &Chart, proposal: ProposalKind, taken: &mut Vec<Rect>) {
    let Some(needs) = model.sufficient(proposal) else { return };
    let fraction = model.fractions(proposal)[nearest(needs as f64)];
    let at = [x(&chart.area, needs as f64), chart.y(fraction.share())];
    scene.dash(&[at, [at[0], chart.area.bottom()]], 1.5, [2.0, 3.0], role(proposal));
    let foot = [at[0], chart.area.bottom()];
    let wordings = [words::NeedsShort { m: &needs }.say(), needs.to_string()];
    let places = [Place::Right(4.0), Place::Left(4.0)].map(|place| raised(place, foot));
    for (place, at) in places {
        let before = taken.len();
        scene.label(taken, &chart.area, at, &wordings, &[place]);
        if taken.len() > before {
            return;
        }
    }
}

/// A place beside a point at the lower edge stands above that edge.
fn raised(place: Place, [x, y]: Point) -> (Place, Point) {
    (place, [x, y - 11.0])
}

/// From where on more universes buy nothing that the laps can tell.
fn nothing_more(
    scene: &mut Scene,
    model: &UniversesModel,
    chart: &Chart,
    proposal: ProposalKind,
    taken: &mut Vec<Rect>,
) {
    let Some(rank) = model.saturated(proposal) else { return };
    let [from, to] = [TRIED[rank] as f64, MOST.into()].map(|m| x(&chart.area, m));
    let y = chart.y(0.3);
    let ends = [from, to].map(|x| vec![[x, y - 4.0], [x, y + 4.0]]);
    let bracket = ends.into_iter().chain([vec![[from, y], [to, y]]]).collect();
    scene.lines(bracket, 1.5, role(proposal));
    let long = words::MoreBuysNothing { from: &TRIED[rank] }.say();
    let letters = strong(SIZE, Role::Ink);
    let names = [&long, words::more_buys_nothing_short()];
    let words = letters.fitting(0.5 * chart.area.w, &names).unwrap_or(names[1]);
    // Ends with the bracket.
    let half = 0.5 * letters.width(words) + 6.0;
    scene.label(taken, &chart.area, [to - half, y + 5.0], &[words], &[Place::Below(2.0)]);
}

/// The rule's operating curve, with the level asked for and, from the number that is read, the way there.
pub fn rule(scene: &mut Scene, model: &UniversesModel, layout: &Layout, taken: &mut Vec<Rect>) {
    let (part, recipe) = (&layout.rule, model.recipe());
    let (area, chart, rule) = (part.area, chart(part), recipe.rule);
    let (k, n) = (&rule.successes(), &rule.seeds);
    let title = [words::Rule { k, n }.say(), words::RuleShort { k, n }.say()];
    scene.fit(part.header, strong(SIZE, Role::Ink), &title);
    frame(scene, part, &[(0.0, Role::Muted), (0.5, Role::Muted), (1.0, Role::Muted)]);
    let at = |passes: f64| area.x + area.w * passes;
    let ticks = [0.0, 0.5, 1.0].map(|share| (at(share), format!("{} %", percent(share))));
    axis(scene, part, &ticks, [words::axis_passes().into(), words::axis_passes_short().into()]);
    scene.dash(&chart.level(ENOUGH), 1.5, LEVEL, Role::Accent);
    let place = |p: f64| [at(rule.passes(p)), chart.y(p)];
    let curve: Vec<Point> = (0..=PLACES).map(|k| place(f64::from(k) / f64::from(PLACES))).collect();
    scene.line(&curve, 2.0, Role::Ink);
    if model.hides() {
        return;
    }
    for proposal in PROPOSALS.into_iter().filter(|proposal| recipe.shows(*proposal)) {
        let (fraction, passes) = model.read(proposal);
        let to = place(fraction.share());
        let from = if layout.share.is_shown() { x(&layout.share.area, TRIED[recipe.rank()] as f64) } else { area.x };
        let way = vec![vec![[from, to[1]], to], vec![to, [to[0], area.bottom()]]];
        scene.dashed(way, 1.0, [2.0, 3.0], role(proposal));
        scene.disc(to, 4.0, role(proposal));
        let said = format!("{} %", percent(passes));
        let places = [Place::Left(8.0), Place::Right(8.0), Place::Below(7.0), Place::Above(7.0)];
        scene.label(taken, &area, to, &[&said], &places);
    }
}

/// The number that is read, and its handle.
pub fn cursor(scene: &mut Scene, model: &UniversesModel, part: &Part) {
    let universes = TRIED[model.recipe().rank()];
    let [x, y] = [x(&part.area, universes as f64), part.area.y];
    scene.line(&[[x, y], [x, part.area.bottom()]], 1.0, Role::Accent);
    scene.pointer([x, y], 6.0);
    scene.handles.push(Handle::of(
        &[UNIVERSES],
        words::universes_handle(),
        [x, y - 5.0],
        universes as f64,
        words::CountOf { m: &universes }.say(),
    ));
}
