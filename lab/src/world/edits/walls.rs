//! Walls that a reader takes away from a place, and puts up in it.

use super::{EditError, body};
use crate::world::{FloorPlan, Segment, collision};
use core::fmt;
use core::str::FromStr;
use std::collections::BTreeSet;

/// Distance of neighbouring points that a wall can begin or end at \[m\].
pub const GRID: f64 = 0.1;

/// Most walls that can be taken away, and as many that can be put up.
pub const MOST_WALLS: usize = 60;

/// No text is longer: two digits for each wall taken away, eight for each put up.
const LONGEST: usize = 2 + 2 * MOST_WALLS + 1 + 8 * MOST_WALLS;

/// Two digits to the base 36.
const DIGITS: u32 = 36;

/// A wall between two points of the grid \[0.1 m\].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct GridWall {
    a: [u16; 2],
    b: [u16; 2],
}

impl GridWall {
    /// The wall between the points of the grid next to two points \[m\]; `None` where they are one, or not on the grid.
    pub fn near(a: [f64; 2], b: [f64; 2]) -> Option<Self> {
        let cell = |x: f64| {
            let cells = (x / GRID).round();
            (0.0..f64::from(DIGITS * DIGITS)).contains(&cells).then_some(cells as u16)
        };
        let point = |p: [f64; 2]| Some([cell(p[0])?, cell(p[1])?]);
        let (a, b) = (point(a)?, point(b)?);
        (a != b).then_some(Self { a, b })
    }

    /// Where it stands.
    pub fn segment(&self) -> Segment {
        // Divided, and not times 0.1: a point of the grid is the number that is written for it.
        let metres = |p: [u16; 2]| p.map(|cells| f64::from(cells) / 10.0);
        Segment { a: metres(self.a), b: metres(self.b) }
    }
}

/// One of the walls of a changed place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum WallId {
    /// Of the course, by its rank: walls first, then furniture.
    Course(u16),
    /// Put up by the reader, by its rank.
    Added(usize),
}

/// Walls taken away, and walls put up.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct WallEdits {
    erased: BTreeSet<u16>,
    added: Vec<GridWall>,
}

impl WallEdits {
    /// Whether nothing is changed.
    pub fn is_empty(&self) -> bool {
        self.erased.is_empty() && self.added.is_empty()
    }

    /// Walls put up.
    pub fn added(&self) -> &[GridWall] {
        &self.added
    }

    /// Puts up a wall.
    ///
    /// # Errors
    /// Where there are too many; all is as it was.
    pub fn add(&mut self, wall: GridWall) -> Result<(), EditError> {
        if self.added.len() == MOST_WALLS {
            return Err(EditError::Many);
        }
        self.added.push(wall);
        Ok(())
    }

    /// Takes a wall away.
    ///
    /// # Errors
    /// Where too many have been; all is as it was.
    pub fn erase(&mut self, wall: WallId) -> Result<(), EditError> {
        match wall {
            WallId::Added(rank) if rank < self.added.len() => {
                self.added.remove(rank);
            }
            WallId::Added(_) => return Err(EditError::Outside),
            WallId::Course(rank) => {
                if self.erased.len() == MOST_WALLS && !self.erased.contains(&rank) {
                    return Err(EditError::Many);
                }
                self.erased.insert(rank);
            }
        }
        Ok(())
    }

    /// The wall next to a point that can be taken away, and how far off it is \[m\].
    pub fn nearest(&self, plan: &FloorPlan, point: [f64; 2]) -> Option<(WallId, f64)> {
        let course = (0..).zip(course_walls(plan)).filter(|(rank, wall)| self.erasable(plan, *rank, wall));
        let course = course.map(|(rank, wall)| (WallId::Course(rank), collision::distance(point, wall)));
        let added = self.added.iter().enumerate();
        let added = added.map(|(rank, wall)| (WallId::Added(rank), collision::distance(point, &wall.segment())));
        // Of what a reader has put up before a wall, the reader's.
        added.chain(course).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn erasable(&self, plan: &FloorPlan, rank: u16, wall: &Segment) -> bool {
        !self.erased.contains(&rank) && !outer(plan, wall)
    }

    /// The place with these changes.
    pub fn apply(&self, plan: &FloorPlan) -> FloorPlan {
        let count = plan.walls.len();
        let left = |segments: &[Segment], first: usize| -> Vec<Segment> {
            let ranked = segments.iter().enumerate();
            ranked.filter(|(k, _)| !self.erased.contains(&((first + k) as u16))).map(|(_, wall)| *wall).collect()
        };
        let mut walls = left(&plan.walls, 0);
        walls.extend(self.added.iter().map(GridWall::segment));
        FloorPlan { size: plan.size, walls, furniture: left(&plan.furniture, count) }
    }

    /// Whether a place can be changed like this.
    pub(super) fn fit(&self, plan: &FloorPlan) -> Result<(), EditError> {
        let all: Vec<&Segment> = course_walls(plan).collect();
        let there = |rank: &u16| all.get(usize::from(*rank)).is_some_and(|wall| !outer(plan, wall));
        let inside = |wall: &GridWall| {
            let Segment { a, b } = wall.segment();
            [a, b].iter().all(|p| p[0] <= plan.size[0] && p[1] <= plan.size[1])
        };
        let fits = self.erased.iter().all(there) && self.added.iter().all(inside);
        if fits { Ok(()) } else { Err(EditError::Outside) }
    }
}

fn course_walls(plan: &FloorPlan) -> impl Iterator<Item = &Segment> {
    plan.walls.iter().chain(&plan.furniture)
}

/// Whether a wall is one of those that keep the robot inside.
fn outer(plan: &FloorPlan, wall: &Segment) -> bool {
    (0..2).any(|axis| wall.a[axis] == wall.b[axis] && [0.0, plan.size[axis]].contains(&wall.a[axis]))
}

impl fmt::Display for WallEdits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return Ok(());
        }
        let digit = |x: u16| char::from_digit(u32::from(x), DIGITS).unwrap_or('0');
        let two = |x: u16| [digit(x / DIGITS as u16), digit(x % DIGITS as u16)];
        let erased: String = self.erased.iter().flat_map(|rank| two(*rank)).collect();
        let added: String = self.added.iter().flat_map(|w| [w.a, w.b].concat()).flat_map(two).collect();
        write!(f, "1.{erased}.{added}")
    }
}

impl FromStr for WallEdits {
    type Err = EditError;

    fn from_str(text: &str) -> Result<Self, EditError> {
        let Some(body) = body(text, LONGEST)? else { return Ok(Self::default()) };
        let (erased, added) = body.split_once('.').ok_or(EditError::Garbled)?;
        let (erased, added) = (numbers(erased)?, numbers(added)?);
        let mut edits = Self::default();
        for rank in &erased {
            edits.erase(WallId::Course(*rank))?;
        }
        if edits.erased.len() != erased.len() || !added.len().is_multiple_of(4) {
            return Err(EditError::Garbled);
        }
        for wall in added.chunks_exact(4) {
            let wall = GridWall { a: [wall[0], wall[1]], b: [wall[2], wall[3]] };
            if wall.a == wall.b {
                return Err(EditError::Garbled);
            }
            edits.add(wall)?;
        }
        if edits.is_empty() { Err(EditError::Garbled) } else { Ok(edits) }
    }
}

/// Numbers of two digits each.
fn numbers(text: &str) -> Result<Vec<u16>, EditError> {
    let digits = text.chars().map(|c| c.to_digit(DIGITS).filter(|_| !c.is_ascii_uppercase()));
    let digits: Vec<u32> = digits.collect::<Option<_>>().ok_or(EditError::Garbled)?;
    if !digits.len().is_multiple_of(2) {
        return Err(EditError::Garbled);
    }
    Ok(digits.chunks_exact(2).map(|two| (DIGITS * two[0] + two[1]) as u16).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_are_read_as_they_are_written() {
        let plan = FloorPlan::apartment();
        let mut edits = WallEdits::default();
        assert_eq!((edits.to_string(), "".parse()), (String::new(), Ok(WallEdits::default())));
        let wall = GridWall::near([4.4, 3.93], [4.4, 5.4]).unwrap();
        edits.add(wall).unwrap();
        edits.erase(WallId::Course(12)).unwrap();
        assert_eq!(edits.to_string(), "1.0c.1813181i");
        assert_eq!(edits.to_string().parse(), Ok(edits.clone()));
        let changed = edits.apply(&plan);
        assert_eq!(changed.walls.len(), plan.walls.len());
        assert_eq!(changed.walls.last(), Some(&Segment { a: [4.4, 3.9], b: [4.4, 5.4] }));
        assert_eq!(edits.fit(&plan), Ok(()));
    }

    #[test]
    fn what_is_written_by_nobody_is_refused() {
        for (text, why) in [
            ("2.0c.", EditError::Version),
            ("0c", EditError::Version),
            ("1.0c", EditError::Garbled),
            ("1..", EditError::Garbled),
            ("1.0C.", EditError::Garbled),
            ("1.0c0c.", EditError::Garbled),
            ("1..1813181", EditError::Garbled),
            ("1..18131813", EditError::Garbled),
            ("1.\u{664}\u{664}.", EditError::Garbled),
            (&format!("1..{}", "0".repeat(2000)), EditError::Long),
        ] {
            assert_eq!(text.parse::<WallEdits>(), Err(why), "{text}");
        }
    }

    #[test]
    fn the_outer_walls_stay_and_no_wall_stands_outside() {
        let plan = FloorPlan::apartment();
        for (text, fits) in [("1.04.", true), ("1.00.", false), ("1.zz.", false), ("1..0000zz00", false)] {
            assert_eq!(text.parse::<WallEdits>().unwrap().fit(&plan).is_ok(), fits, "{text}");
        }
        let (wall, far) = WallEdits::default().nearest(&plan, [6.0, 0.1]).unwrap();
        assert!(wall != WallId::Course(0) && far > 0.1, "not the southern outer wall: {wall:?}");
        let (wall, near) = WallEdits::default().nearest(&plan, [1.0, 3.9]).unwrap();
        assert!(wall == WallId::Course(4) && near < 1e-9, "{wall:?} {near}");
    }

    #[test]
    fn there_are_no_more_walls_than_a_link_can_hold() {
        let wall = GridWall::near([1.0, 1.0], [1.0, 2.0]).unwrap();
        let mut edits = WallEdits::default();
        for rank in 0..MOST_WALLS as u16 {
            edits.add(wall).unwrap();
            edits.erase(WallId::Course(rank)).unwrap();
        }
        assert_eq!((edits.add(wall), edits.erase(WallId::Course(99))), (Err(EditError::Many), Err(EditError::Many)));
        let text = edits.to_string();
        assert_eq!((text.len(), text.parse()), (LONGEST, Ok(edits)));
    }
}
