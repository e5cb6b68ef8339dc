//! Files of results: written beside what is there, and put in its place when they are whole.

use super::Arguments;
use crate::{in_file, picture};
use anyhow::{Context, Result};
use fastslam::geometry::Pose2;
use fastslam::map::grid::{MapImage, MapImageSettings};
use fastslam::mapper::LaserMapper;
use fastslam_log::{write_path, write_tum};
use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile, TempPath};

/// A file to be. Until it is [put](Self::put) in its place, what was there stays there; where that never comes, nothing is left of it.
pub struct Pending {
    place: PathBuf,
    /// What is written in the meantime. A pipe or a device has no such thing: it is written itself.
    beside: Option<TempPath>,
}

impl Pending {
    /// Begins one, which shows whether it can be written.
    pub fn new(path: &Path) -> Result<Self> {
        // A link stays one: what it leads to is replaced.
        let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        remove_left(&place);
        let beside = match place.metadata() {
            Ok(there) if !there.is_file() => None,
            Ok(there) => {
                // What may not be written is not replaced either, and what is keeps its rights.
                File::options().append(true).open(&place).with_context(in_file(path))?;
                let file = beside(&place).with_context(in_file(path))?;
                file.as_file().set_permissions(there.permissions()).with_context(in_file(path))?;
                Some(file)
            }
            Err(_) => Some(beside(&place).with_context(in_file(path))?),
        };
        Ok(Self { place, beside: beside.map(NamedTempFile::into_temp_path) })
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        self.beside.as_deref().unwrap_or(&self.place)
    }

    /// Writes it, and puts it in its place.
    pub fn save(self, bytes: &[u8]) -> Result<()> {
        std::fs::write(self.path(), bytes).with_context(in_file(&self.place))?;
        self.put()
    }

    /// Puts what was written in its place.
    pub fn put(self) -> Result<()> {
        let Some(beside) = self.beside else { return Ok(()) };
        // Whole on the disk before it is seen.
        File::open(&beside).and_then(|file| file.sync_all()).with_context(in_file(&self.place))?;
        beside.persist(&self.place).map_err(|error| error.error).with_context(in_file(&self.place))
    }
}

/// How the name of a file begins that is written beside another one.
fn start(place: &Path) -> OsString {
    [OsStr::new("."), place.file_name().unwrap_or_default(), OsStr::new(".")].into_iter().collect()
}

/// How it ends.
const END: &str = ".part";

/// The folder of a file.
fn folder(place: &Path) -> &Path {
    // A bare name has an empty folder before it.
    place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Removes what runs that were killed have left beside a file, and says so. What a run writes that is still going stays.
fn remove_left(place: &Path) {
    let (start, entries) = (start(place), folder(place).read_dir());
    for file in entries.into_iter().flatten().flatten().map(|entry| entry.path()) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let middle = name.strip_prefix(&*start.to_string_lossy()).and_then(|rest| rest.strip_suffix(END));
        let Some(process) = middle.and_then(|middle| middle.split('.').next()?.parse::<u32>().ok()) else { continue };
        match is_running(process) {
            Some(true) => {}
            Some(false) if std::fs::remove_file(&file).is_ok() => {
                eprintln!("fastslam: {}: removed, as the run that wrote it was killed", file.display());
            }
            _ => eprintln!("fastslam: {}: left by a run that was killed, or written by one now", file.display()),
        }
    }
}

/// Whether there is a process of this number; `None` where the system does not tell.
fn is_running(process: u32) -> Option<bool> {
    let processes = Path::new("/proc");
    processes.join("self").exists().then(|| processes.join(process.to_string()).exists())
}

/// An empty file in the same folder, with the rights that a new file has, and the number of this process in its name.
fn beside(place: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    let mut prefix = start(place);
    prefix.push(format!("{}.", std::process::id()));
    builder.prefix(&prefix).suffix(END);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder(place))
}

/// The files that results go to.
pub struct Outputs {
    trajectory: Option<Pending>,
    path_mcap: Option<Pending>,
    map: Option<MapOutputs>,
}

/// Those of a map, and what its picture is called in the YAML.
struct MapOutputs {
    png: Pending,
    pgm: Pending,
    yaml: Pending,
    image: String,
}

impl MapOutputs {
    fn new(name: &Path) -> Result<Self> {
        let named = |extension: &str| {
            let mut file = name.to_owned().into_os_string();
            file.push(extension);
            PathBuf::from(file)
        };
        let [png, pgm, yaml] = [".png", ".pgm", ".yaml"].map(named);
        let image = pgm.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let [png, pgm, yaml] = [&png, &pgm, &yaml].map(|path| Pending::new(path));
        Ok(Self { png: png?, pgm: pgm?, yaml: yaml?, image })
    }
}

impl Outputs {
    /// Begins them. What is there stays until they are written.
    pub fn open(arguments: &Arguments) -> Result<Self> {
        let Arguments { trajectory, path_mcap, map, session, .. } = arguments;
        let open = |path: &Option<PathBuf>| path.as_deref().map(Pending::new).transpose();
        // That of the session is not kept open: it is written at any time.
        open(session)?;
        let map = map.as_deref().map(MapOutputs::new).transpose()?;
        Ok(Self { trajectory: open(trajectory)?, path_mcap: open(path_mcap)?, map })
    }

    /// Writes a path.
    pub fn write_path(self, path: &[(f64, Pose2)]) -> Result<()> {
        if let Some(file) = self.trajectory {
            file.save(write_tum(path).as_bytes())?;
        }
        if let Some(file) = self.path_mcap {
            file.save(&write_path(path).map_err(anyhow::Error::msg)?)?;
        }
        Ok(())
    }

    /// Writes a path and the map of a mapper.
    pub fn write(mut self, mapper: &LaserMapper, path: &[(f64, Pose2)], rules: &MapImageSettings) -> Result<()> {
        let map = self.map.take();
        self.write_path(path)?;
        if let Some(MapOutputs { png, pgm, yaml, image }) = map {
            let (whole, strips) = MapImage::in_strips(mapper.map(), path, rules, picture::ROWS)?;
            let open = mapper.open_loops().filter_map(|one| mapper.at_step(one.to));
            let open: Vec<_> = open.map(|(_, pose)| pose).collect();
            picture::save_map(&whole, strips, path, &open, [pgm.path(), png.path()])?;
            std::fs::write(yaml.path(), whole.yaml(&image)).with_context(in_file(yaml.path()))?;
            [png, pgm, yaml].into_iter().try_for_each(Pending::put)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            folder.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_was_there_stays_until_the_new_file_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.pgm");
        std::fs::write(&path, "before").unwrap();
        let dropped = Pending::new(&path).unwrap();
        std::fs::write(dropped.path(), "half").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
        drop(dropped);
        assert_eq!(names(folder.path()), ["map.pgm"]);
        Pending::new(&path).unwrap().save(b"after").unwrap();
        assert_eq!((std::fs::read_to_string(&path).unwrap().as_str(), names(folder.path()).len()), ("after", 1));
        assert!(Pending::new(&folder.path().join("no/such/folder")).is_err());
    }

    /// Of a process that is not there, of this one, and of names that are not ours.
    #[cfg(target_os = "linux")]
    #[test]
    fn what_a_killed_run_has_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.pgm");
        let mine = format!(".map.pgm.{}.abc.part", std::process::id());
        let others = [".map.pgm.abc.part", ".map.png.4294967295.abc.part", "map.pgm.4294967295.part", "map.pgm", &mine];
        for name in others.iter().chain([&".map.pgm.4294967295.abc.part"]) {
            std::fs::write(folder.path().join(name), name).unwrap();
        }
        drop(Pending::new(&path).unwrap());
        let mut left = others.map(str::to_owned).to_vec();
        left.sort();
        assert_eq!(names(folder.path()), left);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "map.pgm");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_one_and_a_device_is_written_itself() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["file", "link"].map(|name| folder.path().join(name));
        std::fs::write(&file, "").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        Pending::new(&link).unwrap().save(b"new").unwrap();
        assert!(link.is_symlink() && std::fs::read_to_string(&file).unwrap() == "new");
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
        let usual = folder.path().join("usual");
        std::fs::write(&usual, "").unwrap();
        assert_eq!(mode(&file), mode(&usual));
        Pending::new(Path::new("/dev/null")).unwrap().save(b"gone").unwrap();
        assert!(!Path::new("/dev/null").metadata().unwrap().is_file());
    }
}
