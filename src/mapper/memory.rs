//! What a mapper keeps, in bytes.

use super::{LaserMapper, Map};
use crate::genealogy::Path;
use crate::map::Footprint;

/// What a [`LaserMapper`] keeps.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Memory {
    /// Size of the particles' maps.
    pub maps: Footprint,
    /// Bytes of the maps of before by which loops are found, which they do not share with [`Self::maps`].
    pub kept_map_bytes: u64,
    /// Number of the scans by which a path that is bent is mapped again: at most [`LaserMapperSettings::kept_scans`](super::LaserMapperSettings::kept_scans).
    pub kept_scans: u32,
    /// Bytes of these scans, and of where on the way each one that was taken is.
    pub scan_bytes: u64,
    /// Bytes of the particles' paths, of odometry and of the times of all scans.
    pub path_bytes: u64,
}

impl Memory {
    /// All of it \[bytes\].
    pub fn bytes(&self) -> u64 {
        self.maps.unique + self.kept_map_bytes + self.scan_bytes + self.path_bytes
    }
}

impl LaserMapper {
    /// Bytes of all particles' maps.
    pub fn footprint(&self) -> Footprint {
        Map::footprint(self.filter.particles().iter().map(|particle| &particle.map))
    }

    /// The same with the maps of before that are kept to find loops by.
    pub fn footprint_with_kept(&self) -> Footprint {
        Map::footprint(self.filter.particles().iter().map(|particle| &particle.map).chain(self.closings.maps()))
    }

    /// What the mapper keeps, which grows with the way. What is besides, as the scans that tell what moves, is of a bounded number.
    pub fn memory(&self) -> Memory {
        let maps = self.footprint();
        let [kept_scans, _, scan_bytes] = self.closings.kept_scans();
        let poses = self.filter.descent().size() as usize * Path::NODE_BYTES
            + size_of_val(&self.stamps[..])
            + size_of_val(&self.odometry[..]);
        Memory {
            maps,
            kept_map_bytes: self.footprint_with_kept().unique - maps.unique,
            kept_scans: kept_scans as u32,
            scan_bytes: scan_bytes as u64,
            path_bytes: poses as u64,
        }
    }
}
