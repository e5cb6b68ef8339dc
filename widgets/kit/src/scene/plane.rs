//! From the world \[m\] to the picture \[css px\], and back.

use super::{Point, Rect, clip_polyline, closed, ellipse, thinned};

/// A part of the world as it is drawn: upright, at one scale, cut at the edges of an area.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Plane {
    /// Where it is drawn \[css px\].
    pub area: Rect,
    /// A place of the world \[m\].
    pub place: [f64; 2],
    /// Where that is \[css px\].
    pub at: Point,
    /// Css px per metre.
    pub scale: f64,
}

impl Plane {
    /// With a place of the world \[m\] in the middle of the area.
    pub fn centred(area: Rect, place: [f64; 2], scale: f64) -> Self {
        Self { area, place, at: area.centre(), scale }
    }

    /// With a place of the world \[m\] in the upper left corner of the area.
    pub fn from_upper_left(area: Rect, place: [f64; 2], scale: f64) -> Self {
        Self { area, place, at: [area.x, area.y], scale }
    }

    /// With a place of the world \[m\] in the lower left corner of the area.
    pub fn from_lower_left(area: Rect, place: [f64; 2], scale: f64) -> Self {
        Self { area, place, at: [area.x, area.bottom()], scale }
    }

    /// As large as all between two corners of the world \[m\] fits into the middle of the area, this far from its edges \[css px\].
    pub fn around(area: Rect, [low, high]: [[f64; 2]; 2], margin: f64) -> Self {
        let [w, h] = [0, 1].map(|k| (high[k] - low[k]).max(1e-3));
        let room = area.inset(margin);
        let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        Self::centred(area, middle, (room.w / w).min(room.h / h))
    }

    /// Where a place of the world \[m\] is \[css px\].
    pub fn point(&self, [x, y]: [f64; 2]) -> Point {
        [self.at[0] + (x - self.place[0]) * self.scale, self.at[1] - (y - self.place[1]) * self.scale]
    }

    /// What place of the world \[m\] is at a point \[css px\].
    pub fn world(&self, [x, y]: Point) -> [f64; 2] {
        [self.place[0] + (x - self.at[0]) / self.scale, self.place[1] - (y - self.at[1]) / self.scale]
    }

    /// A line through places of the world \[m\], cut at the edges. Points nearer than `least` \[css px\] to the one before are left out.
    pub fn way(&self, places: &mut dyn Iterator<Item = [f64; 2]>, least: f64) -> Vec<Vec<Point>> {
        clip_polyline(&thinned(&mut places.map(|place| self.point(place)), least), &self.area)
    }

    /// The points at a Mahalanobis distance from a Gaussian of the world, by its mean \[m\] and covariance \[m²\], cut at the edges.
    pub fn region(&self, mean: [f64; 2], [[xx, xy], [yx, yy]]: [[f64; 2]; 2], distance: f64) -> Vec<Vec<Point>> {
        let [xx, xy, yx, yy] = [xx, -xy, -yx, yy].map(|c| c * self.scale * self.scale);
        clip_polyline(&closed(ellipse(self.point(mean), [[xx, xy], [yx, yy]], distance)), &self.area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Rect = Rect::new(100.0, 50.0, 400.0, 300.0);

    #[test]
    fn every_place_is_found_again_at_its_point() {
        for plane in [
            Plane::centred(AREA, [3.0, -2.0], 10.0),
            Plane::from_upper_left(AREA, [3.0, -2.0], 10.0),
            Plane::from_lower_left(AREA, [3.0, -2.0], 10.0),
            Plane::around(AREA, [[-1.0, -2.0], [5.0, 0.0]], 20.0),
        ] {
            assert_eq!(plane.point(plane.place), plane.at);
            let [x, y] = plane.world(plane.point([1.5, -0.3]));
            assert!((x - 1.5).abs() < 1e-12 && (y + 0.3).abs() < 1e-12);
            assert!(plane.point([0.0, 1.0])[1] < plane.point([0.0, 0.0])[1], "up is up");
        }
    }

    #[test]
    fn all_that_is_to_be_seen_fits_inside_of_the_margin() {
        for high in [[5.0, 0.0], [0.0, 7.0], [-1.0, -2.0]] {
            let plane = Plane::around(AREA, [[-1.0, -2.0], high], 20.0);
            let [a, b] = [[-1.0, -2.0], high].map(|corner| plane.point(corner));
            let seen = Rect::new(a[0], b[1], b[0] - a[0], a[1] - b[1]);
            assert!(AREA.inset(20.0).encloses(&seen), "{seen:?}");
        }
    }

    #[test]
    fn what_is_correlated_upwards_in_the_world_rises_in_the_picture() {
        let plane = Plane::centred(AREA, [0.0; 2], 10.0);
        let lines = plane.region([0.0; 2], [[4.0, 3.0], [3.0, 4.0]], 1.0);
        let right = lines[0].iter().copied().max_by(|a, b| a[0].total_cmp(&b[0])).unwrap();
        assert!((right[0] - plane.at[0] - 20.0).abs() < 0.1 && right[1] < plane.at[1], "{right:?}");
        assert!(plane.region([90.0, 0.0], [[1.0, 0.0], [0.0, 1.0]], 1.0).is_empty());
    }
}
