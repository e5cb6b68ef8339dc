//! Maps that were drawn, and pictures of maps read back.

use super::*;

/// A room of 3 m × 2 m, seen from its middle.
fn room() -> Grid<4> {
    let mut grid = Grid::new(GridModel { cell_size: 0.05, log_odds_bounds: [-2.0, 3.5], distance_reach: 2, ..MODEL });
    let beams = 720_u16;
    let range = |k: u16| {
        let (sin, cos): (f64, f64) = ops::sin_cos(f64::from(k) * core::f64::consts::TAU / f64::from(beams));
        (1.5 / cos.abs().max(1e-9)).min(1.0 / sin.abs().max(1e-9))
    };
    let ranges: Vec<f64> = (0..beams).map(range).collect();
    let scan = BeamSensor::panorama(beams.into(), 8.0, 0.0).scan(&ranges);
    (0..3).for_each(|_| grid.assimilate(&Pose2::new(0.01, 0.02, 0.0), &scan, &()));
    grid
}

const READING: MapReading = MapReading {
    mode: GreyMode::Trinary,
    resolution: 0.05,
    origin: Pose2 { x: 0.0, y: 0.0, theta: 0.0 },
    negate: false,
    occupied_thresh: 0.65,
    free_thresh: 0.196,
};

/// Written, read back, and written again: occupied, free and unknown cells are the same, and every wall has its end points.
#[test]
fn a_map_that_is_read_from_its_own_picture_is_written_as_the_same_picture() {
    let grid = room();
    let settings = MapImageSettings { footprint_radius: 0.0, ..MapImageSettings::default() };
    let image = MapImage::of(&grid, &[], &settings).unwrap();
    let read = MapImage::from_pgm(&image.pgm(), &READING).unwrap();
    assert_eq!((read.width, read.height, &read.grey), (image.width, image.height, &image.grey));
    let drawn = Grid::<4>::drawn(grid.model, &read, &READING).unwrap();
    let again = MapImage::of(&drawn, &[], &settings).unwrap();
    assert_eq!((again.origin, &again.grey), ([0.0, 0.0], &image.grey));
    for black in (0..image.grey.len()).filter(|k| image.grey[*k] == 0) {
        let (column, row) = (black as u32 % image.width, image.height - 1 - black as u32 / image.width);
        let [x, y] = [column, row].map(|k| (f64::from(k) + 0.5) * 0.05);
        let [mean_x, mean_y] = drawn.ndt_mean(column as i32 / 4, row as i32 / 4).unwrap();
        assert!((x - mean_x).abs() < 0.2 && (y - mean_y).abs() < 0.2, "({column}, {row})");
    }
}

/// However many rows a strip has, and where the robot's circle lies across several of them.
#[test]
fn the_strips_of_a_picture_are_the_picture() {
    let (grid, settings) = (room(), MapImageSettings { footprint_radius: 0.7, ..MapImageSettings::default() });
    let path = [(0.0, Pose2::default()), (1.0, Pose2::new(0.4, 0.6, 0.0))];
    let whole = MapImage::of(&grid, &path, &settings).unwrap();
    for rows in [0, 1, 7, whole.height, u32::MAX] {
        let (ungreyed, strips) = MapImage::in_strips(&grid, &path, &settings, rows).unwrap();
        assert_eq!(ungreyed, MapImage { grey: Vec::new(), ..whole.clone() });
        let strips: Vec<_> = strips.collect();
        assert_eq!(strips.len() as u32, whole.height.div_ceil(rows.max(1)), "{rows}");
        assert!(strips.iter().all(|strip| strip.width == whole.width && strip.height <= rows.max(1)));
        assert_eq!(strips.last().unwrap().origin, whole.origin, "{rows}");
        let greys: Vec<u8> = strips.into_iter().flat_map(|strip| strip.grey).collect();
        assert!(greys == whole.grey, "{rows}");
    }
}

/// By map_server's rule: black, white, and greys of which the share of black is 0.2, 0.4 and 0.6, read by thresholds of 0.3 and 0.5.
#[test]
fn greys_are_read_as_mode_negation_and_thresholds_say() {
    let reading = MapReading { occupied_thresh: 0.5, free_thresh: 0.3, ..READING };
    let read = |reading: MapReading| [0, 255, 204, 153, 102].map(|grey| reading.occupied(grey));
    assert_eq!(read(reading), [Some(1.0), Some(0.0), Some(0.0), None, Some(1.0)]);
    assert_eq!(read(MapReading { negate: true, ..reading }), [Some(0.0), Some(1.0), Some(1.0), Some(1.0), None]);
    let scaled = read(MapReading { mode: GreyMode::Scale, ..reading });
    assert!((scaled[3].unwrap() - 0.5).abs() < 1e-12, "{scaled:?}");
    assert_eq!([scaled[0], scaled[1], scaled[2], scaled[4]], [Some(1.0), Some(0.0), Some(0.0), Some(1.0)]);
    // Probabilities of 0.40 and 0.83: the first is more likely free, and the second a wall.
    let image = MapImage { width: 2, height: 1, origin: [0.0; 2], cell_size: 0.05, grey: vec![158, 136] };
    let scale = MapReading { mode: GreyMode::Scale, ..reading };
    let grid = Grid::<1>::drawn(GridModel { cell_size: 0.05, ..MODEL }, &image, &scale).unwrap();
    assert!((grid.log_odds(0, 0) + 0.396).abs() < UNIT && grid.ndt_mean(0, 0).is_none());
    assert!((grid.log_odds(1, 0) - ops::ln(5.0)).abs() < UNIT && grid.ndt_mean(1, 0).is_some());
}

#[test]
fn a_picture_that_is_none_is_refused_with_what_is_wrong() {
    let read = |file: &[u8]| MapImage::from_pgm(file, &READING).map(|image| image.grey).map_err(|e| e.to_string());
    assert_eq!(read(b"P5 # of a robot\n2 1\n# and more\n255\n\x00\xcd").unwrap(), [0, 205]);
    assert_eq!(read(b"P5 2 1 15 \x0f\x03").unwrap(), [255, 51], "stretched");
    for (file, said) in [
        (&b"P2 2 1 255 0 0"[..], "expected a picture in binary PGM, which begins with P5"),
        (b"P5 0 1 255\n", "width = 0: must be a whole number from 1 to 65535"),
        (b"P5 2 # ", "height = NaN: must be a whole number from 1 to 65535"),
        (b"P5 2 1 65535 \0\0\0\0", "maxval = 65535: must be a whole number from 1 to 255"),
        (b"P5 2 2 255\n\0\0\0", "expected 4 bytes of greys, found 3"),
    ] {
        assert_eq!(read(file).unwrap_err(), said);
    }
    let image = MapImage::from_pgm(b"P5 1 1 255 \0", &READING).unwrap();
    let drawn = |reading: MapReading| {
        let model = GridModel { cell_size: 0.05, ..MODEL };
        Grid::<1>::drawn(model, &image, &reading).map(drop).unwrap_err().to_string()
    };
    for (reading, said) in [
        (MapReading { resolution: 1.0, ..READING }, "resolution = 1: must be a number from 0.02 to 0.2 [m]"),
        (MapReading { resolution: 0.1, ..READING }, "cell_size: must be the resolution of the picture"),
        (MapReading { free_thresh: -0.1, ..READING }, "free_thresh = -0.1: must be a number from 0 to 1"),
        (MapReading { occupied_thresh: f64::NAN, ..READING }, "occupied_thresh = NaN: must be a number from 0 to 1"),
        (MapReading { free_thresh: 0.7, ..READING }, "free_thresh: must be at most occupied_thresh"),
    ] {
        assert_eq!(drawn(reading), said);
    }
    assert_eq!("raw".parse::<GreyMode>().unwrap_err().to_string(), "mode = raw: must be trinary or scale");
}
