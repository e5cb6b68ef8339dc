//! From a log of a robot with a laser, in CARMEN's format, to a map as ROS reads it and a path as evo reads it.
//!
//! `cargo run --release -p fastslam-log --example laser_log -- robot.clf folder`

use fastslam::map::grid::{MapImage, MapImageSettings};
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Pushed};
use fastslam_log::{parse, write_tum};
use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [log, folder] = arguments.as_slice() else {
        return Err("needs two arguments: the log, and the folder for map.pgm, map.yaml and path.tum".into());
    };
    // A line that is not CARMEN's is refused with its number; `true` would pass over it and note so.
    let log = parse(&fs::read(log)?, false)?;

    let settings = LaserMapperSettings { particles: 30, seed: 1, ..LaserMapperSettings::default() };
    let mut mapper = LaserMapper::new(settings.for_scans(&log.scans))?;
    for scan in &log.scans {
        match mapper.push(scan) {
            Pushed::Step(report) if report.step % 100 == 0 => println!(
                "step {}: effective sample size {:.1}, {} paths left at the start",
                report.step,
                report.selection_ess,
                mapper.filter().lineage()
            ),
            Pushed::Refused(reason) => println!("left out: {reason}"),
            Pushed::First | Pushed::Still | Pushed::Step(_) => {}
        }
    }

    let (folder, path) = (Path::new(folder), mapper.path());
    let map = MapImage::of(mapper.map(), &path, &MapImageSettings::default())?;
    fs::create_dir_all(folder)?;
    fs::write(folder.join("map.pgm"), map.pgm())?;
    fs::write(folder.join("map.yaml"), map.yaml("map.pgm"))?;
    fs::write(folder.join("path.tum"), write_tum(&path))?;
    println!("{} of {} scans mapped, into {}", mapper.steps() + 1, log.scans.len(), folder.display());
    Ok(())
}
