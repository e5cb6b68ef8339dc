//! Grids as the tiles that they share.

use super::tile::{self, SavedTile, Tile};
use super::{CellRect, Directory, Grid, GridModel, ray_trace};
use crate::error::Range;
use crate::save::{self, RestoreError, SaveShared};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Grids that share their tiles, each tile once. A grid's past is a directory like its present.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SavedGrids {
    tiles: Vec<SavedTile>,
    directories: Vec<SavedDirectory>,
    grids: Vec<SavedGrid>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct SavedDirectory {
    /// i0, j0, i1, j1 \[tiles\].
    rect: [i32; 4],
    tiles: Vec<Option<u32>>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct SavedGrid {
    model: GridModel,
    directory: u32,
    scans: u32,
    past: Vec<(u32, u32)>,
}

/// Scans that a grid may have mapped: so many more can follow.
const SCANS: Range = Range::whole(0, u32::MAX / 2);

impl<const CELLS_PER_NDT: usize> SaveShared for Grid<CELLS_PER_NDT> {
    type Saved = SavedGrids;

    fn save_all<'a>(grids: impl IntoIterator<Item = &'a Self>) -> SavedGrids {
        let (mut tiles, mut directories) = (save::Table::default(), save::Table::default());
        let grids = grids.into_iter().map(|grid| SavedGrid {
            model: grid.model,
            directory: directories.index(&grid.directory),
            scans: grid.scans,
            past: grid.past.iter().map(|(scans, directory)| (*scans, directories.index(directory))).collect(),
        });
        let grids = grids.collect();
        let directories = directories.things.into_iter().map(|directory| {
            let CellRect { i0, j0, i1, j1 } = directory.rect;
            let tiles = directory.tiles.iter().map(|tile| tile.as_ref().map(|tile| tiles.index(tile)));
            SavedDirectory { rect: [i0, j0, i1, j1], tiles: tiles.collect() }
        });
        let directories = directories.collect();
        SavedGrids { tiles: tiles.things.iter().map(|tile| tile.save()).collect(), directories, grids }
    }

    fn restore_all(SavedGrids { tiles, directories, grids }: SavedGrids) -> Result<Vec<Self>, RestoreError> {
        let tiles =
            tiles.iter().map(|saved| Ok(Arc::new(saved.restore()?))).collect::<Result<Vec<_>, RestoreError>>()?;
        let directories = directories.into_iter().map(|SavedDirectory { rect: [i0, j0, i1, j1], tiles: indices }| {
            // One tile more to each side than any scan needs: see `ray_trace::FARTHEST`.
            let farthest = f64::from(ray_trace::FARTHEST as i32 / Self::TILE_CELLS + 4);
            for corner in [i0, j0, i1, j1] {
                Range::number(-farthest, farthest, "tiles").check("maps.directories.rect", f64::from(corner))?;
            }
            save::holds(i0 <= i1 && j0 <= j1, "maps.directories.rect", "in order: i0, j0, i1, j1")?;
            let rect = CellRect { i0, j0, i1, j1 };
            save::count("maps.directories.tiles", indices.len(), rect.width() * rect.height())?;
            let tile =
                |index: Option<u32>| index.map(|index| save::at("maps.tiles", &tiles, index).cloned()).transpose();
            Ok(Arc::new(Directory { rect, tiles: indices.into_iter().map(tile).collect::<Result<_, RestoreError>>()? }))
        });
        let directories = directories.collect::<Result<Vec<_>, RestoreError>>()?;
        let directory = |index| save::at("maps.directories", &directories, index).cloned();
        let mut restored: Vec<Self> = Vec::with_capacity(grids.len());
        for SavedGrid { model, directory: present, scans, past } in grids {
            model.validate()?;
            SCANS.check("maps.scans", f64::from(scans))?;
            let ages: Vec<u32> = past.iter().map(|(scans, _)| *scans).chain([scans]).collect();
            save::holds(ages.is_sorted(), "maps.past", "in order, and before the present")?;
            let past = past.into_iter().map(|(scans, index)| Ok((scans, directory(index)?)));
            let past = past.collect::<Result<_, RestoreError>>()?;
            let blank = match restored.last() {
                Some(last) if last.model == model => last.blank(),
                _ => Self::among(&tiles, model),
            };
            restored.push(Self { directory: directory(present)?, scans, past, ..blank });
        }
        Ok(restored)
    }
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// An unknown world whose clear tile is that of these tiles, if there is one.
    fn among(tiles: &[Arc<Tile<CELLS_PER_NDT>>], model: GridModel) -> Self {
        let [free, _] = model.log_odds_bounds.map(tile::units);
        let mut grid = Self::new(model);
        if let Some(clear) = tiles.iter().find(|tile| tile.is_clear(free)) {
            grid.clear = Arc::clone(clear);
        }
        grid
    }
}
