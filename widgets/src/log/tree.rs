//! The paths of all universes, every piece once: the best from start to end, each of the others up to where it joins what was drawn,
//! and what died out a short while ago.

use fastslam::{
    experiment::log::LogRun,
    geometry::Pose2,
    lineage::{Ancestry, NodeId},
};

/// The universes that one resampling let die out.
#[derive(Clone, PartialEq, Debug)]
pub struct Death {
    /// The step.
    pub step: u32,
    /// Their newest nodes.
    pub nodes: Vec<NodeId>,
}

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
    /// Of the present population, and of these deaths.
    pub fn new(run: &LogRun, deaths: &[Death]) -> Self {
        let filter = run.filter();
        let (ancestry, nodes) = (filter.ancestry(), filter.nodes());
        let best = nodes[filter.best()];
        let mut drawn = ancestry.alive(&[best]);
        let path = ancestry.path(best).into_iter().rev().collect();
        let others =
            nodes.iter().map(|node| branch(ancestry, *node, &mut drawn)).filter(|line| line.len() > 1).collect();
        let now = ancestry.steps() - 1;
        let recent = deaths.iter().rev().filter(|death| now - death.step < FADE);
        let dead = recent.flat_map(|death| death.nodes.iter().map(move |node| (now - death.step, *node)));
        let dead = dead.map(|(age, node)| (age, branch(ancestry, node, &mut drawn)));
        Self { best: path, others, dead: dead.filter(|(_, line)| line.len() > 1).collect() }
    }
}

/// From a node back to the first that is drawn already, and that one.
fn branch(ancestry: &Ancestry, node: NodeId, drawn: &mut [bool]) -> Vec<Pose2> {
    let mut line = vec![ancestry.pose(node)];
    let mut next = Some(node).filter(|node| !core::mem::replace(&mut drawn[*node as usize], true));
    while let Some(parent) = next.and_then(|node| ancestry.parent(node)) {
        line.push(ancestry.pose(parent));
        next = Some(parent).filter(|node| !core::mem::replace(&mut drawn[*node as usize], true));
    }
    line
}
