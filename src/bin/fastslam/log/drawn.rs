//! A map that was drawn, as `map_server` of ROS reads it: a YAML file and a picture.

use crate::{Usage, in_file};
use anyhow::{Context, Result};
use fastslam::geometry::Pose2;
use fastslam::map::grid::{MapImage, MapReading};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The YAML file. What else is in it, `map_server` does not read either.
#[derive(Deserialize)]
struct Yaml {
    image: PathBuf,
    #[serde(default)]
    mode: Option<String>,
    resolution: f64,
    origin: [f64; 3],
    #[serde(default)]
    negate: Negate,
    occupied_thresh: f64,
    free_thresh: f64,
}

/// 0 or 1, or in words.
#[derive(Default, Deserialize)]
#[serde(untagged)]
enum Negate {
    #[default]
    No,
    Word(bool),
    Number(u64),
}

/// The map of a YAML file.
pub fn read(path: &Path) -> Result<(MapImage, MapReading)> {
    let text = std::fs::read_to_string(path).with_context(in_file(path))?;
    let yaml: Yaml = serde_norway::from_str(&text).map_err(|error| Usage::of_file(path, error))?;
    let negate = match yaml.negate {
        Negate::No | Negate::Number(0) | Negate::Word(false) => false,
        Negate::Number(1) | Negate::Word(true) => true,
        Negate::Number(number) => {
            return Err(Usage::of_file(path, format_args!("negate = {number}: must be 0 or 1")).into());
        }
    };
    let [x, y, yaw] = yaml.origin;
    let mode = yaml.mode.as_deref().map(str::parse).transpose().map_err(|error| Usage::of_file(path, error))?;
    let reading = MapReading {
        mode: mode.unwrap_or_default(),
        resolution: yaml.resolution,
        origin: Pose2 { x, y, theta: yaw },
        negate,
        occupied_thresh: yaml.occupied_thresh,
        free_thresh: yaml.free_thresh,
    };
    reading.validate().map_err(|error| Usage::of_file(path, error))?;
    let reading = MapReading { origin: Pose2::new(x, y, yaw), ..reading };
    // Beside the YAML file, if it does not say from where.
    let picture = path.parent().unwrap_or(Path::new("")).join(&yaml.image);
    let file = std::fs::read(&picture).with_context(in_file(&picture))?;
    let image = MapImage::from_pgm(&file, &reading).map_err(|error| Usage::of_file(&picture, error))?;
    Ok((image, reading))
}
