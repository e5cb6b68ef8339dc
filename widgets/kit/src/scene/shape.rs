//! Outlines made of points.

use super::Point;

/// Corners of an ellipse: enough that no edge is seen at any size of a figure.
const CORNERS: usize = 64;

/// How many deviations a region reaches that holds 90 % of a Gaussian of the plane: √χ²₂,₀.₉ = √(−2 ln 0.1).
pub const NINE_TENTHS: f64 = 2.145_966_026_289_347;

/// The points at Mahalanobis distance `scale` from a Gaussian's mean, as a polygon: `centre + scale · L (cos t, sin t)`, where
/// L Lᵀ is the covariance.
///
/// `centre` in css px, `covariance` in px², both with y down: a covariance of the world changes the sign off its diagonal.
/// Variances that rounding made negative count as 0. What is not finite gives no points.
pub fn ellipse(centre: Point, covariance: [[f64; 2]; 2], scale: f64) -> Vec<Point> {
    let [[xx, _], [yx, yy]] = covariance;
    // Cholesky's factor, lower left.
    let a = xx.max(0.0).sqrt();
    let b = if a > 0.0 { yx / a } else { 0.0 };
    let c = (yy - b * b).max(0.0).sqrt();
    if ![centre[0], centre[1], xx, yx, yy, b, scale].iter().all(|x| x.is_finite()) {
        return Vec::new();
    }
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * k as f64 / CORNERS as f64);
        [centre[0] + scale * a * cos, centre[1] + scale * (b * cos + c * sin)]
    };
    (0..CORNERS).map(corner).collect()
}

/// A polygon as a line that ends where it begins: its outline.
pub fn closed(mut polygon: Vec<Point>) -> Vec<Point> {
    polygon.extend(polygon.first().copied());
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_of_an_ellipse_is_at_the_same_mahalanobis_distance() {
        let [[xx, xy], [yx, yy]] = [[9.0, -3.0], [-3.0, 4.0]];
        let determinant = xx * yy - xy * yx;
        for [x, y] in ellipse([10.0, 20.0], [[xx, xy], [yx, yy]], 2.0) {
            let [dx, dy] = [x - 10.0, y - 20.0];
            let squared = (yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / determinant;
            assert!((squared - 4.0).abs() < 1e-12, "{squared}");
        }
    }

    #[test]
    fn an_ellipse_without_width_is_a_line_and_one_of_no_numbers_is_nothing() {
        assert!(ellipse([0.0; 2], [[0.0, 0.0], [0.0, 1.0]], 1.0).iter().all(|p| p[0] == 0.0 && p[1].abs() <= 1.0));
        assert!(ellipse([0.0; 2], [[1.0, 1.0], [1.0, 1.0 - 1e-17]], 1.0).iter().all(|p| (p[0] - p[1]).abs() < 1e-12));
        assert_eq!(ellipse([0.0; 2], [[f64::NAN, 0.0], [0.0, 1.0]], 1.0), Vec::<Point>::new());
        assert_eq!(ellipse([0.0; 2], [[1.0, 0.0], [0.0, f64::INFINITY]], 1.0), Vec::<Point>::new());
    }

    #[test]
    fn an_outline_ends_where_it_begins() {
        assert_eq!(closed(vec![[0.0, 0.0], [1.0, 0.0]]), [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]);
        assert!(closed(Vec::new()).is_empty());
    }
}
