//! Where the parts of the figure stand: all charts below each other on one axis of time, and the maps of the policies beside them; on a
//! phone above them, one at a time, with a tab for each.

use crate::{
    panels::Panels,
    scene::{LINE, Rect},
    view,
};

/// Names of the panels: four charts, and where the particles are.
pub const ESS: &str = "n-eff";
/// See [`ESS`].
pub const LINEAGE: &str = "ancestors";
/// See [`ESS`].
pub const ERROR: &str = "error";
/// See [`ESS`].
pub const TREE: &str = "tree";
/// See [`ESS`].
pub const PARTICLES: &str = "particles";
/// The charts, by rank.
pub const CHARTS: [&str; 4] = [ESS, LINEAGE, ERROR, TREE];

/// From this width on \[css px\], the maps stand beside the charts.
pub const WIDE: f64 = 560.0;

/// What stands left of the charts, for the ends of their scales and the threshold \[css px\].
pub const SCALE: f64 = 48.0;

/// The line above a chart, a row of ticks, and the line with steps \[css px\].
const LABEL: f64 = 17.0;
const ROW: f64 = 12.0;
const AXIS: f64 = 15.0;
/// Height of a tab on a phone \[css px\], for a finger, and what is free above it: the first pixel of a picture is paper.
const TAB: f64 = 40.0;
const FREE: f64 = 1.0;
/// From this width of all that belongs to the charts on \[css px\], values stand beside them with the names of the policies.
const NAMED: f64 = 460.0;

/// How the heights of the charts go together.
const SHARES: [f64; 4] = [0.29, 0.22, 0.17, 0.32];

/// What differs by the course: of the lap the maps are small, and in the two wings they are what is to be seen.
struct Shape {
    /// Width of a map beside the charts, over its height.
    aspect: f64,
    /// The most of the figure's width that it takes.
    share: f64,
    /// Height of a map above the charts \[css px\].
    above: f64,
}

/// Of the lap, and of the loop of ambiguity.
const SHAPES: [Shape; 2] =
    [Shape { aspect: 1.5, share: 0.25, above: 72.0 }, Shape { aspect: 2.7, share: 0.41, above: 104.0 }];

/// The parts of the figure on one course \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Parts {
    /// Name of each policy; a click on it, or on its map, chooses the policy.
    pub tabs: [Rect; 3],
    /// Where the particles are: a map for each policy, or on a phone one for the policy that is chosen.
    pub maps: Vec<Rect>,
    /// A line with names above N_eff, lineage, errors and tree each.
    pub labels: [Rect; 4],
    /// N_eff, lineage, errors and tree over the steps: one width, so that one cursor goes through all.
    pub charts: [Rect; 4],
    /// Below N_eff, a row for each policy with a tick wherever it resampled.
    pub ticks: [Rect; 3],
    /// Right of N_eff and its ticks, lineage and errors each, for what the cursor reads.
    pub values: [Rect; 4],
    /// Whether there is room for the policies' names beside the values.
    pub named: bool,
    /// Below the charts, for steps.
    pub axis: Rect,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// Which panels are shown.
    pub panels: Panels,
    /// Whether the maps stand beside the charts, all three.
    pub wide: bool,
    /// On the lap, and in the loop of ambiguity: of one height.
    pub courses: [Parts; 2],
    /// What marks mean.
    pub legend: Rect,
    /// Of the whole figure.
    pub height: f64,
}

/// The height of the whole figure \[css px\]: such that it is on one screen with its controls, which stand below it from the second
/// width on, and beside it up to the first and from the third on.
fn whole(width: f64) -> f64 {
    if width < WIDE {
        450.0
    } else if width <= 780.0 {
        440.0
    } else if width < 940.0 {
        400.0
    } else {
        0.54 * width
    }
}

/// Between parts \[css px\].
fn gap(width: f64) -> f64 {
    if width < WIDE { 4.0 } else { 6.0 }
}

/// Lines and gaps of the charts that are shown \[css px\].
fn lines(panels: &Panels, gap: f64) -> f64 {
    let count = CHARTS.iter().filter(|name| panels.has(name)).count() as f64;
    let ticks = if panels.has(ESS) { 3.0 * ROW + gap } else { 0.0 };
    let axis = if count > 0.0 { AXIS } else { 0.0 };
    count * (LABEL + gap) + ticks + axis
}

/// The part of the room for charts that those shown take.
fn share(panels: &Panels) -> f64 {
    CHARTS.iter().zip(SHARES).filter(|(name, _)| panels.has(name)).map(|(_, share)| share).sum()
}

impl view::Layout for Layout {
    const NARROWEST: f64 = 320.0;
    const PANELS: &'static [&'static str] = &[ESS, LINEAGE, ERROR, TREE, PARTICLES];

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let (wide, gap) = (width >= WIDE, gap(width));
        let all = whole(width) - LINE - gap;
        let above = if wide { 0.0 } else { FREE + TAB + SHAPES[1].above + 2.0 * gap };
        let room = all - above - lines(&Panels::default(), gap);
        let charts = lines(panels, gap) + room * share(panels);
        let height = match (panels.has(PARTICLES), share(panels) > 0.0) {
            _ if panels.are_all() => all,
            (true, true) if wide => charts.max(0.6 * all),
            (true, false) if wide => LINE + 0.15 * width,
            (true, _) => above + charts,
            (false, _) => charts,
        };
        let courses = SHAPES.map(|shape| Parts::new(width, height, panels, &shape));
        // What marks mean is said below all of them.
        let legend = if panels.are_all() { Rect::new(0.0, height + gap, width, LINE) } else { NOWHERE };
        let height = if panels.are_all() { legend.bottom() } else { height };
        Self { panels: panels.clone(), wide, courses, legend, height: height.ceil() }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

const NOWHERE: Rect = Rect::new(0.0, 0.0, 0.0, 0.0);

impl Parts {
    /// In so much room, from the upper left corner on.
    fn new(width: f64, height: f64, panels: &Panels, shape: &Shape) -> Self {
        let (maps_shown, charts_shown) = (panels.has(PARTICLES), share(panels) > 0.0);
        let mut parts = Self {
            tabs: [NOWHERE; 3],
            maps: Vec::new(),
            labels: [NOWHERE; 4],
            charts: [NOWHERE; 4],
            ticks: [NOWHERE; 3],
            values: [NOWHERE; 4],
            named: false,
            axis: NOWHERE,
        };
        let corner = match (maps_shown, width >= WIDE) {
            (false, _) => [0.0, 0.0],
            (true, true) if charts_shown => parts.maps_beside(width, height, shape),
            (true, true) => parts.maps_in_a_row(width, height),
            (true, false) => {
                parts.map_below_tabs(width, if charts_shown { shape.above } else { height - FREE - TAB - gap(width) })
            }
        };
        if charts_shown {
            parts.place_charts(corner, [width, height], panels);
        }
        parts
    }

    /// All maps at the left, one below the other; says where the charts begin.
    fn maps_beside(&mut self, width: f64, height: f64, shape: &Shape) -> [f64; 2] {
        let gap = gap(width);
        let card = (height - 2.0 * gap) / 3.0;
        let w = (shape.aspect * (card - LINE)).min(shape.share * width).round();
        for (k, tab) in self.tabs.iter_mut().enumerate() {
            *tab = Rect::new(0.0, k as f64 * (card + gap), w, LINE);
            self.maps.push(Rect::new(0.0, tab.bottom(), w, card - LINE));
        }
        [w + 3.0 * gap, 0.0]
    }

    /// All maps side by side, and nothing else.
    fn maps_in_a_row(&mut self, width: f64, height: f64) -> [f64; 2] {
        let gap = gap(width);
        let w = (width - 4.0 * gap) / 3.0;
        for (k, tab) in self.tabs.iter_mut().enumerate() {
            *tab = Rect::new(k as f64 * (w + 2.0 * gap), 0.0, w, LINE);
            self.maps.push(Rect::new(tab.x, LINE, w, height - LINE));
        }
        [0.0, height]
    }

    /// One map below a tab for each policy; says where the charts begin.
    fn map_below_tabs(&mut self, width: f64, height: f64) -> [f64; 2] {
        let gap = gap(width);
        let w = (width - 2.0 * gap) / 3.0;
        self.tabs = [0.0, 1.0, 2.0].map(|k| Rect::new(k * (w + gap), FREE, w, TAB));
        self.maps.push(Rect::new(0.0, FREE + TAB + gap, width, height));
        [0.0, self.maps[0].bottom() + gap]
    }

    /// The charts between two corners, each with as much of the room as goes together with the others.
    fn place_charts(&mut self, [left, top]: [f64; 2], [right, bottom]: [f64; 2], panels: &Panels) {
        let gap = gap(right);
        self.named = right - left >= NAMED;
        let beside = if self.named { 116.0 } else { 58.0 };
        let (x, w) = (left + SCALE, right - left - SCALE - beside);
        let room = (bottom - top - lines(panels, gap)) / share(panels);
        let values = |y: f64, h: f64| Rect::new(x + w + 6.0, y, beside - 6.0, h);
        let mut y = top;
        for (rank, name) in CHARTS.iter().enumerate().filter(|(_, name)| panels.has(name)) {
            // Nothing is written beside the tree.
            let end = if *name == TREE { right } else { x + w };
            self.labels[rank] = Rect::new(left, y, end - left, LABEL);
            self.charts[rank] = Rect::new(x, y + LABEL, w, room * SHARES[rank]);
            y = self.charts[rank].bottom() + gap;
            match *name {
                ESS => {
                    self.ticks = [0.0, 1.0, 2.0].map(|k| Rect::new(x, y + k * ROW, w, ROW));
                    self.values[0] = values(self.charts[0].y, self.charts[0].h);
                    self.values[1] = values(y, 3.0 * ROW);
                    y += 3.0 * ROW + gap;
                }
                TREE => (),
                _ => self.values[rank + 1] = values(self.charts[rank].y, self.charts[rank].h),
            }
        }
        self.axis = Rect::new(left, bottom - AXIS, right - left, AXIS);
    }

    /// Where the particles of a policy are.
    pub fn map(&self, policy: usize) -> Rect {
        self.maps.get(policy).or(self.maps.first()).copied().unwrap_or(NOWHERE)
    }

    /// The first chart that is shown.
    pub fn first_chart(&self) -> Rect {
        self.charts.into_iter().find(|chart| chart.h > 0.0).unwrap_or(NOWHERE)
    }

    /// Where the cursor follows a pointer: over all charts.
    pub fn over_time(&self) -> Rect {
        let Rect { x, y, w, .. } = self.first_chart();
        Rect::new(x, y, w, self.axis.y - y)
    }

    /// All parts.
    pub fn all(&self) -> Vec<Rect> {
        [&self.tabs[..], &self.maps, &self.labels, &self.charts, &self.ticks, &self.values, &[self.axis]].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_apart;
    use crate::view::Layout as _;

    const PANELS: [&str; 5] = [ESS, LINEAGE, ERROR, TREE, PARTICLES];

    fn widths() -> impl Iterator<Item = f64> {
        (320..2000).step_by(7).map(f64::from)
    }

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for width in widths() {
            let layout = Layout::new(width);
            for parts in &layout.courses {
                let parts = [parts.all(), vec![layout.legend]].concat();
                assert!(parts.iter().all(|part| part.w > 0.0 && part.h > 0.0), "{width}");
                assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
            }
        }
    }

    #[test]
    fn the_figure_is_on_one_screen_with_its_controls() {
        let within = |widths: core::ops::RangeInclusive<u32>, least: f64, most: f64| {
            for width in widths.map(f64::from) {
                let height = Layout::new(width).height;
                assert!((least..=most).contains(&height), "{height} at {width}");
            }
        };
        within(700..=760, 430.0, 460.0);
        within(800..=930, 0.0, 400.0);
        within(588..=588, 0.0, 460.0);
        within(340..=390, 0.0, 450.0);
        for width in (941..=1150).map(f64::from) {
            assert!(Layout::new(width).height <= 0.56 * width, "at {width}");
        }
    }

    #[test]
    fn one_cursor_goes_through_all_charts_and_ticks() {
        for width in [320.0, 559.0, 560.0, 1280.0] {
            for Parts { charts, ticks, .. } in Layout::new(width).courses {
                assert!(charts.iter().chain(&ticks).all(|c| (c.x, c.w) == (charts[0].x, charts[0].w)), "{width}");
                assert!(charts[0].w > 180.0, "{width}: {}", charts[0].w);
            }
        }
    }

    #[test]
    fn in_the_loop_the_maps_are_about_twice_as_large_and_nothing_below_the_figure_moves() {
        for width in [352.0, 588.0, 728.0, 804.0, 1112.0] {
            let [lap, wings] = Layout::new(width).courses;
            let area = |parts: &Parts| parts.maps[0].w * parts.maps[0].h;
            let ratio = area(&wings) / area(&lap);
            assert!((1.4..2.2).contains(&ratio), "{width}: {ratio}");
            assert_eq!(lap.axis.bottom(), wings.axis.bottom(), "{width}");
        }
    }

    #[test]
    fn a_finger_hits_the_tabs_of_a_phone() {
        for width in [320.0, 352.0, 559.0] {
            for parts in Layout::new(width).courses {
                assert_eq!(parts.maps.len(), 1);
                assert!(parts.tabs.iter().all(|tab| tab.w > 90.0 && tab.h >= 40.0), "{width}");
            }
        }
    }

    #[test]
    fn panels_shown_alone_leave_no_place_for_the_others() {
        let of = |charts: usize, ess: usize, maps: usize| charts * 2 + usize::from(charts > 0) + ess * 4 + maps;
        // Of each chart but the tree, what the cursor reads beside it.
        for (names, [wide, narrow]) in [
            ("tree", [of(1, 0, 0); 2]),
            ("n-eff error", [of(2, 1, 0) + 2; 2]),
            ("particles", [of(0, 0, 6), of(0, 0, 4)]),
            ("ancestors particles", [of(1, 0, 6) + 1, of(1, 0, 4) + 1]),
        ] {
            let panels = Panels::named(names, &PANELS).unwrap();
            for width in widths() {
                let layout = Layout::of(width, &panels);
                for parts in &layout.courses {
                    let parts: Vec<Rect> = parts.all().into_iter().filter(|part| part.h > 0.0).collect();
                    assert_eq!(parts.len(), if width >= WIDE { wide } else { narrow }, "{names} at {width}");
                    assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
                    assert!(layout.height < 0.8 * Layout::new(width).height, "{names} at {width}");
                }
            }
        }
    }
}
