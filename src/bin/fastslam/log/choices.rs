//! What can be chosen of how a log is mapped, by options and by a file of settings.

use crate::settings::from_toml;
use crate::{Usage, whole};
use anyhow::Result;
use fastslam::error::SettingError;
use fastslam::map::grid::MapImageSettings;
use fastslam::mapper::LaserMapperSettings;
use fastslam::proposal::IncrementalWeight;
use fastslam_log::BagOptions;
use serde::Deserialize;
use std::path::Path;

/// Options that a file of settings may have as well.
macro_rules! choices {
    ($($(#[$attribute:meta])* $name:ident: $type:ty;)*) => {
        #[derive(clap::Args, Clone, Debug, Default, Deserialize)]
        #[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
        pub struct Choices {
            $($(#[$attribute])* $name: Option<$type>,)*
        }

        impl Choices {
            /// What is chosen here, and where nothing is, there.
            fn or(self, other: Self) -> Self {
                Self { $($name: self.$name.or(other.$name),)* }
            }
        }
    };
}

choices! {
    /// Number of particles M, 1 to 4096. One maps a building of which there is a scan every half metre as well as sixteen, in an eighth of the time;
    /// outdoors, or where scans are a metre apart, sixteen leave the fewest loops open [default: 16]
    #[arg(long, value_name = "M", value_parser = whole(LaserMapperSettings::PARTICLES), allow_negative_numbers = true)]
    particles: usize;
    /// Seed of the filter's draws [default: 1]
    #[arg(long)]
    seed: u64;
    /// What a particle pays for a scan: marginal, new-ground-free or old-map-at-draw [default: new-ground-free]
    #[arg(long)]
    weight: IncrementalWeight;
    /// Side of a cell of the map [m], 0.02 to 0.2 [default: 0.05]
    #[arg(long, alias = "resolution", value_name = "METRES", allow_negative_numbers = true)]
    cell: f64;
    /// Ranges beyond this [m], 0.5 to 200, are not matched [default: 30]
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    max_range: f64;
    /// How far the way is free [m] where nothing is in reach, 0 to 200: a range of +inf in a bag, null in JSON lines. 0: such a beam says
    /// nothing, as what it passed may be glass [default: 0]
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    clear_range: f64;
    /// Pass scans over until the robot has driven this far [m], or turned by as many radians, 0 to 5 [default: 0]
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    min_travel: f64;
    /// Learn drift and noise of the wheels along the way; false keeps to what is assumed of any wheels, for comparisons [default: true]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL")]
    learn_wheels: bool;
    /// Where a path is bent to close a loop, map about so many of the scans so far again for each new one, 0 to 1000000, so that no scan takes long;
    /// the corrected path takes over when it is mapped. 0: all of them at once [default: 0]
    #[arg(long, value_name = "SCANS", allow_negative_numbers = true)]
    remapped_per_scan: u32;
    /// Most scans that are kept to map a path again that is bent, 100 to 10000000: beyond that every second of the older ones is let go, and the end of the run tells it
    /// [default: 100000]
    #[arg(long, value_name = "SCANS", allow_negative_numbers = true)]
    kept_scans: u32;
    /// Pass malformed lines and messages over, and count them; read a bag that breaks off up to there
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL")]
    lenient: bool;
    /// Topic of a bag's scans (sensor_msgs/LaserScan): needed where several have some
    #[arg(long, value_name = "TOPIC")]
    scan_topic: String;
    /// Topic of a bag's odometry (nav_msgs/Odometry, or tf): needed where several have some
    #[arg(long, value_name = "TOPIC")]
    odometry_topic: String;
    /// Frame that a bag's transforms tell odometry in, where it is neither odom nor the first one above the laser that the robot moves in
    #[arg(long, value_name = "FRAME")]
    odometry_frame: String;
    /// Cells of the written map whose probability of being occupied is above this are occupied, 0.5 to 1: one hit alone gives 0.71 [default: 0.65]
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    occupied_threshold: f64;
    /// Cells of the written map whose probability of being occupied is below this are free, 0 to 0.5: one pass alone gives 0.40. Cells
    /// between the two thresholds are unknown [default: 0.5]
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    free_threshold: f64;
    /// Radius of the robot [m], 0 to 5: a circle of this size is free in the written map wherever the robot has been; 0: no circle [default: 0.2]
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    footprint_radius: f64;
}

impl Choices {
    /// What is chosen by options, and by the file of settings where no option does.
    pub fn read(self, file: Option<&Path>) -> Result<Self> {
        let Some(file) = file else { return Ok(self) };
        let of_file: Self = from_toml(file)?;
        let checked = of_file.mapper(LaserMapperSettings::default()).validate().and_then(|()| of_file.map().validate());
        checked.map_err(|error| Usage::of_file(file, by_flag(error)))?;
        Ok(self.or(of_file))
    }

    /// The settings of a mapper that are chosen, and others as they are by default or in a session.
    pub fn mapper(&self, default: LaserMapperSettings) -> LaserMapperSettings {
        LaserMapperSettings {
            particles: self.particles.unwrap_or(default.particles),
            seed: self.seed.unwrap_or(default.seed),
            cell_size: self.cell.unwrap_or(default.cell_size),
            max_range: self.max_range.unwrap_or(default.max_range),
            clear_range: self.clear_range.unwrap_or(default.clear_range),
            min_travel: self.min_travel.unwrap_or(default.min_travel),
            weight: self.weight.unwrap_or(default.weight),
            learn_wheels: self.learn_wheels.unwrap_or(default.learn_wheels),
            remapped_per_scan: self.remapped_per_scan.unwrap_or(default.remapped_per_scan),
            kept_scans: self.kept_scans.unwrap_or(default.kept_scans),
            ..default
        }
    }

    pub fn map(&self) -> MapImageSettings {
        let default = MapImageSettings::default();
        MapImageSettings {
            occupied_threshold: self.occupied_threshold.unwrap_or(default.occupied_threshold),
            free_threshold: self.free_threshold.unwrap_or(default.free_threshold),
            footprint_radius: self.footprint_radius.unwrap_or(default.footprint_radius),
        }
    }

    pub fn bag(&self) -> BagOptions {
        BagOptions {
            scan_topic: self.scan_topic.clone(),
            odometry_topic: self.odometry_topic.clone(),
            odometry_frame: self.odometry_frame.clone(),
            lenient: self.lenient.unwrap_or_default(),
        }
    }
}

/// A refusal by the flag that its reader gave.
pub fn by_flag(error: SettingError) -> SettingError {
    match error.field() {
        "cell_size" => error.called("cell"),
        "max_range" => error.called("max-range"),
        "clear_range" => error.called("clear-range"),
        "min_travel" => error.called("min-travel"),
        "remapped_per_scan" => error.called("remapped-per-scan"),
        "kept_scans" => error.called("kept-scans"),
        "occupied_threshold" => error.called("occupied-threshold"),
        "free_threshold" => error.called("free-threshold"),
        "footprint_radius" => error.called("footprint-radius"),
        _ => error,
    }
}

/// What can be chosen of a mapper, by the names of the options.
pub fn listed(settings: &LaserMapperSettings) -> String {
    let LaserMapperSettings {
        particles,
        seed,
        weight,
        cell_size,
        max_range,
        clear_range,
        min_travel,
        learn_wheels,
        remapped_per_scan,
        kept_scans,
        ..
    } = settings;
    format!(
        "particles = {particles}, seed = {seed}, weight = {weight}, cell = {cell_size}, max-range = {max_range}, \
         clear-range = {clear_range}, min-travel = {min_travel}, learn-wheels = {learn_wheels}, \
         remapped-per-scan = {remapped_per_scan}, kept-scans = {kept_scans}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Args;

    #[test]
    fn help_tells_the_defaults_of_the_crate() {
        let command = Choices::augment_args(clap::Command::new("log"));
        let mapper = Choices::default().mapper(LaserMapperSettings::default());
        let map = Choices::default().map();
        for (name, default) in [
            ("particles", mapper.particles.to_string()),
            ("seed", mapper.seed.to_string()),
            ("weight", mapper.weight.to_string()),
            ("cell", mapper.cell_size.to_string()),
            ("max_range", mapper.max_range.to_string()),
            ("clear_range", mapper.clear_range.to_string()),
            ("min_travel", mapper.min_travel.to_string()),
            ("learn_wheels", mapper.learn_wheels.to_string()),
            ("remapped_per_scan", mapper.remapped_per_scan.to_string()),
            ("kept_scans", mapper.kept_scans.to_string()),
            ("occupied_threshold", map.occupied_threshold.to_string()),
            ("free_threshold", map.free_threshold.to_string()),
            ("footprint_radius", map.footprint_radius.to_string()),
        ] {
            let argument = command.get_arguments().find(|argument| argument.get_id() == name).unwrap();
            let help = argument.get_help().unwrap().to_string();
            assert!(help.ends_with(&format!("[default: {default}]")), "{name}: {help}");
        }
    }
}
