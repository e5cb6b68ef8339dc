//! What a landmark filter is told of noise, from options and from a file of settings.

use crate::{Usage, in_file};
use anyhow::{Context, Result, bail};
use fastslam::error::{Range, SettingError};
use fastslam::map::landmarks::Gate;
use fastslam::motion::{Car, Displaced, VelocityDiffusion, VelocityModel};
use fastslam_lab::experiment::landmarks::Tuning;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Every setting by its name: that of its option, of its key in a file, and of what a refusal names.
macro_rules! settings {
    ($($(#[$doc:meta])* $name:ident $flag:literal $value:literal: $range:expr;)*) => {
        /// What stands over the noises that a log or a course comes with; nothing where it is not set.
        #[derive(clap::Args, Clone, Copy, PartialEq, Debug, Default, Deserialize)]
        #[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
        pub struct Noises {
            /// Shares of the motion's variance: σ²_v = speed_std² + α₁ v² + α₂ ω², σ²_ω = turn_rate_std² + α₃ v² + α₄ ω²; four numbers from 0
            /// to 100
            #[arg(long, value_name = "A1,A2,A3,A4", allow_hyphen_values = true)]
            alphas: Option<Alphas>,
            $(
                $(#[$doc])*
                #[arg(long = $flag, value_name = $value, value_parser = number($range), allow_negative_numbers = true)]
                $name: Option<f64>,
            )*
        }

        impl Noises {
            /// What is set here, and where it is not, there.
            fn or(self, other: Self) -> Self {
                Self { alphas: self.alphas.or(other.alphas), $($name: self.$name.or(other.$name),)* }
            }

            /// Whether all are in range; options have been asked already.
            fn check(&self) -> Result<(), SettingError> {
                $(if let Some(value) = self.$name {
                    $range.check($flag, value)?;
                })*
                self.alphas.iter().flat_map(|alphas| alphas.0).try_for_each(|alpha| SHARE.check("alphas", alpha).map(drop))
            }

            /// The settings that are set, by their names.
            fn given(&self) -> Vec<&'static str> {
                let mut given = Vec::new();
                given.extend(self.alphas.map(|_| "alphas"));
                $(given.extend(self.$name.map(|_| $flag));)*
                given
            }
        }
    };
}

const SHARE: Range = Range::number(0.0, 100.0, "");

settings! {
    /// Noise of the speed at rest: of a step in a course [m/s], of a second in a recorded log [m/√s]; of a car [m/s]
    speed_std "speed-std" "M/S": Range::number(0.0, 100.0, "m/s");
    /// Noise of the turn rate at rest: of a step in a course [rad/s], of a second in a recorded log [rad/√s]
    turn_rate_std "turn-rate-std" "RAD/S": Range::number(0.0, 100.0, "rad/s");
    /// Noise of a range [m]
    range_std "range-std" "M": Range::number(0.0, 1000.0, "m");
    /// Noise of a bearing [rad]
    bearing_std "bearing-std" "RAD": Range::number(0.0, 10.0, "rad");
    /// With --association unknown: how far landmarks that should have been seen must be in range [m]
    max_range "max-range" "M": Range::number(0.0, 1e6, "m");
    /// With --association unknown: in what field of view [rad]
    field_of_view "field-of-view" "RAD": Range::number(0.0, 7.0, "rad");
    /// With --association unknown: landmarks of one map nearer than this, in deviations squared, are merged; 0: none
    merge "merge" "D2": Range::number(0.0, 100.0, "");
    /// With --association unknown: misses that a sighting pays for; 0: landmarks that are not seen stay
    sighting_worth "sighting-worth" "N": Range::whole(0, 1000);
    /// With --association unknown: most misses that a landmark can have in hand
    most_count "most-count" "N": Range::whole(1, 1_000_000);
    /// Of a car: distance of the axles [m]
    wheel_base "wheel-base" "M": Range::number(0.1, 100.0, "m");
    /// Of a car: where its sensor stands, ahead of the rear axle [m]
    mount_ahead "mount-ahead" "M": Range::number(-100.0, 100.0, "m");
    /// Of a car: and left of its middle [m]
    mount_left "mount-left" "M": Range::number(-100.0, 100.0, "m");
    /// Of a car: noise of the speed as a share of it
    speed_share "speed-share" "SHARE": Range::number(0.0, 10.0, "");
    /// Of a car: noise of the steering angle [rad]
    steering_std "steering-std" "RAD": Range::number(0.0, 1.5, "rad");
}

/// An option's number in a range, which the refusal of any other names.
fn number(range: Range) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(number) if range.contains(number) => Ok(number),
        _ => Err(format!("must be {range}")),
    }
}

/// α₁ to α₄.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
pub struct Alphas([f64; 4]);

impl FromStr for Alphas {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let alphas: Option<Vec<f64>> =
            text.split(',').map(|word| word.trim().parse().ok().filter(|alpha| SHARE.contains(*alpha))).collect();
        let four = alphas.and_then(|alphas| <[f64; 4]>::try_from(alphas).ok());
        four.map(Self).ok_or_else(|| "must be four numbers from 0 to 100, apart by commas".into())
    }
}

/// Options of noise, and the file they can be read from.
#[derive(clap::Args)]
pub struct SettingsOptions {
    /// Read settings from this file, in TOML, by the names of the options without dashes before them; an option stands over the file
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    #[command(flatten)]
    noises: Noises,
}

impl SettingsOptions {
    /// What is set by options, and by the file where no option does.
    pub fn read(&self) -> Result<Noises> {
        let Some(path) = &self.settings else { return Ok(self.noises) };
        let noises: Noises = from_toml(path)?;
        noises.check().map_err(|error| Usage::of_file(path, error))?;
        Ok(self.noises.or(noises))
    }
}

/// What a file in TOML says, or what is wrong with it, and in which line.
pub fn from_toml<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = std::fs::read_to_string(path).with_context(in_file(path))?;
    toml::from_str(&text).map_err(|error| {
        let line = error.span().map(|span| 1 + text[..span.start].matches('\n').count());
        let place = line.map_or(String::new(), |line| format!("line {line}: "));
        let said: Vec<&str> = error.message().split_whitespace().collect();
        Usage::of_file(path, format_args!("{place}{}", said.join(" "))).into()
    })
}

/// A motion whose noise can be set.
pub trait Adjust: Sized {
    /// The settings that it has, by name.
    const NAMES: &'static [&'static str];
    /// What it is, for the refusal of a setting that it has not.
    const KIND: &'static str;

    /// The same with what is set.
    fn adjusted(self, noises: &Noises) -> Self;
}

const OF_VELOCITIES: &[&str] = &["alphas", "speed-std", "turn-rate-std"];

/// Those that are not of a motion.
const OF_SENSOR: &[&str] =
    &["range-std", "bearing-std", "max-range", "field-of-view", "merge", "sighting-worth", "most-count"];

impl Adjust for VelocityModel {
    const NAMES: &'static [&'static str] = OF_VELOCITIES;
    const KIND: &'static str = "a course";

    fn adjusted(self, noises: &Noises) -> Self {
        Self {
            speed_std: noises.speed_std.unwrap_or(self.speed_std),
            turn_rate_std: noises.turn_rate_std.unwrap_or(self.turn_rate_std),
            alphas: noises.alphas.map_or(self.alphas, |alphas| alphas.0),
        }
    }
}

impl Adjust for VelocityDiffusion {
    const NAMES: &'static [&'static str] = OF_VELOCITIES;
    const KIND: &'static str = "a log of velocities";

    fn adjusted(self, noises: &Noises) -> Self {
        Self {
            speed_std: noises.speed_std.unwrap_or(self.speed_std),
            turn_rate_std: noises.turn_rate_std.unwrap_or(self.turn_rate_std),
            alphas: noises.alphas.map_or(self.alphas, |alphas| alphas.0),
        }
    }
}

impl Adjust for Car {
    const NAMES: &'static [&'static str] =
        &["wheel-base", "mount-ahead", "mount-left", "speed-std", "speed-share", "steering-std"];
    const KIND: &'static str = "a car";

    fn adjusted(self, noises: &Noises) -> Self {
        Self {
            wheel_base: noises.wheel_base.unwrap_or(self.wheel_base),
            mount: [noises.mount_ahead.unwrap_or(self.mount[0]), noises.mount_left.unwrap_or(self.mount[1])],
            speed_std: noises.speed_std.unwrap_or(self.speed_std),
            speed_share: noises.speed_share.unwrap_or(self.speed_share),
            steering_std: noises.steering_std.unwrap_or(self.steering_std),
        }
    }
}

impl Adjust for Displaced {
    const NAMES: &'static [&'static str] = &[];
    const KIND: &'static str = "a graph, whose edges bring the noise of odometry with them";

    fn adjusted(self, _: &Noises) -> Self {
        self
    }
}

impl Noises {
    /// A tuning with what is set here.
    ///
    /// # Errors
    /// Where something is set that the motion has not, or the settings do not fit each other.
    pub fn adjust<D: Adjust>(&self, tuning: Tuning<D>) -> Result<Tuning<D>> {
        if let Some(name) = self.given().into_iter().find(|name| !D::NAMES.contains(name) && !OF_SENSOR.contains(name))
        {
            bail!(Usage(format!("{name}: cannot be set of {}", D::KIND)));
        }
        let Tuning { motion, mut sensor, mut gate } = tuning;
        sensor.range_std = self.range_std.unwrap_or(sensor.range_std);
        sensor.bearing_std = self.bearing_std.unwrap_or(sensor.bearing_std);
        sensor.max_range = self.max_range.unwrap_or(sensor.max_range);
        sensor.field_of_view = self.field_of_view.unwrap_or(sensor.field_of_view);
        gate.merge_squared = self.merge.unwrap_or(gate.merge_squared);
        if let Some(worth) = self.sighting_worth {
            gate = Gate { removal: worth > 0.0, sighting_worth: worth.max(1.0) as u32, ..gate };
        }
        gate.most_count = self.most_count.map_or(gate.most_count, |count| count as u32);
        if gate.most_count < gate.sighting_worth {
            let least = gate.sighting_worth;
            bail!(Usage(format!("most-count = {}: must be at least sighting-worth = {least}", gate.most_count)));
        }
        Ok(Tuning { motion: motion.adjusted(self), sensor, gate })
    }

    /// Whether anything is set.
    pub fn is_empty(&self) -> bool {
        self.given().is_empty()
    }
}
