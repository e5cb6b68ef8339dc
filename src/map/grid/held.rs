//! What grids hold together: how much, and the fingerprint of it.

use super::tile::Tile;
use super::{Directory, Grid};
use crate::map::Footprint;
use crate::order::distinct;
use core::hash::Hasher;
use std::sync::Arc;

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Bytes that these grids hold together, each shared part counted once, against dense arrays of their own.
    ///
    /// Counted as on a 64-bit machine everywhere, and without the allocator's slack: the same number on every platform.
    pub fn footprint<'a>(grids: impl IntoIterator<Item = &'a Self>) -> Footprint {
        Self::footprint_of(&grids.into_iter().collect::<Vec<_>>())
    }

    fn footprint_of(grids: &[&Self]) -> Footprint {
        const POINTER: usize = 8;
        let dense: usize =
            grids.iter().map(|grid| grid.directory.tiles.len() * Tile::<CELLS_PER_NDT>::DENSE_BYTES).sum();
        let directories: Vec<_> = grids.iter().copied().flat_map(Self::directories).collect();
        let directories = distinct(&directories, |directory| Arc::as_ptr(directory).addr() as u64);
        let pointers: usize = directories.iter().map(|d| d.tiles.len() * POINTER).sum();
        let tiles = Self::tiles_of(&directories);
        let unique = pointers + tiles.iter().map(|tile| tile.bytes()).sum::<usize>();
        Footprint { unique: unique as u64, dense: dense as u64 }
    }

    /// The tiles of directories, each once.
    #[inline(never)]
    fn tiles_of<'a>(directories: &[&'a Arc<Directory<CELLS_PER_NDT>>]) -> Vec<&'a Arc<Tile<CELLS_PER_NDT>>> {
        // A directory mostly differs from the one before in few tiles. All tiles of all of them in one list would be larger than the maps.
        let (mut tiles, mut before) = (Vec::new(), &[][..]);
        for directory in directories {
            for (k, tile) in directory.tiles.iter().enumerate() {
                if let Some(tile) = tile
                    && !is_at(before, k, tile)
                {
                    tiles.push(tile);
                }
            }
            before = &directory.tiles;
        }
        distinct(&tiles, |tile| Arc::as_ptr(tile).addr() as u64)
    }

    /// Puts all that these grids hold into a fingerprint: the log-odds of every cell, and every distribution, bit for bit. A tile that a grid shares with the
    /// one before is not read again, so that a family of maps costs little more than what its [`Self::footprint`] is.
    pub fn hash_all<'a, H: Hasher + Default>(grids: impl IntoIterator<Item = &'a Self>, hasher: &mut H) {
        let (mut before, mut hashed) = (&[][..], Vec::new());
        for Directory { rect, tiles } in grids.into_iter().flat_map(Self::directories).map(|directory| &**directory) {
            [rect.i0, rect.j0, rect.i1, rect.j1].into_iter().for_each(|k| hasher.write(&k.to_le_bytes()));
            hashed.resize(tiles.len(), 0);
            for (k, tile) in tiles.iter().enumerate() {
                let value = match tile {
                    None => 0,
                    Some(tile) if is_at(before, k, tile) => hashed[k],
                    Some(tile) => {
                        let mut hasher = H::default();
                        tile.hash_into(&mut hasher);
                        hasher.finish()
                    }
                };
                hashed[k] = value;
                hasher.write(&u64::to_le_bytes(value));
            }
            before = tiles;
        }
    }

    /// Of the present and of the past.
    fn directories(&self) -> impl Iterator<Item = &Arc<Directory<CELLS_PER_NDT>>> {
        core::iter::once(&self.directory).chain(self.past.iter().map(|(_, directory)| directory))
    }
}

/// Whether this tile is at this place.
fn is_at<T>(tiles: &[Option<Arc<T>>], place: usize, tile: &Arc<T>) -> bool {
    matches!(tiles.get(place), Some(Some(known)) if Arc::ptr_eq(known, tile))
}
