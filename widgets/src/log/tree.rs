//! The paths of all universes, every piece once: the best from start to end, each of the others up to where it joins what was drawn,
//! and what died out a short while ago.

use super::kept::Seen;
use fastslam::{genealogy::Path, geometry::Pose2};
use std::collections::BTreeSet;

/// Steps for which a path that died out is still drawn, fading.
pub const FADE: u32 = 12;

/// Paths as poses, newest first.
pub struct Tree {
    /// Of the best universe.
    pub best: Vec<Pose2>,
    /// What the others do not share with it.
    pub others: Vec<Vec<Pose2>>,
    /// What died out, and how many steps ago: 0 to before [`FADE`].
    pub dead: Vec<(u32, Vec<Pose2>)>,
}

impl Tree {
    /// Of a population, and of what had died out before.
    pub fn new(Seen { paths, best, deaths, .. }: &Seen) -> Self {
        let best = &paths[*best];
        let mut drawn = Drawn { best: best.back().map(Path::id).collect(), now: best.step(), others: BTreeSet::new() };
        let others = paths.iter().map(|path| drawn.branch(path)).filter(|line| line.len() > 1).collect();
        let recent = deaths.iter().rev().filter(|death| best.step() - death.step < FADE);
        let dead = recent.flat_map(|death| death.paths.iter().map(move |path| (best.step() - death.step, path)));
        let dead = dead.map(|(age, path)| (age, drawn.branch(path))).filter(|(_, line)| line.len() > 1);
        let dead = dead.collect();
        Self { best: best.back().map(Path::pose).collect(), others, dead }
    }
}

/// What is drawn already.
struct Drawn {
    /// The nodes of the best path, newest first: its step tells where to look for a node.
    best: Vec<usize>,
    /// The newest step.
    now: u32,
    /// Nodes of other paths.
    others: BTreeSet<usize>,
}

impl Drawn {
    /// Whether a node was not drawn yet.
    fn draw(&mut self, path: &Path) -> bool {
        self.best[(self.now - path.step()) as usize] != path.id() && self.others.insert(path.id())
    }

    /// From a path's end back to the first that is drawn already, and that one.
    fn branch(&mut self, path: &Path) -> Vec<Pose2> {
        let mut line = vec![path.pose()];
        let mut next = Some(path).filter(|path| self.draw(path));
        while let Some(before) = next.and_then(Path::before) {
            line.push(before.pose());
            next = Some(before).filter(|path| self.draw(path));
        }
        line
    }
}
