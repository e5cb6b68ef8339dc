//! How much a scan must show at another place to be believed against odometry.

use crate::mapper::agreement::Agreement;

/// What a scan must show at another place to be believed against odometry.
pub(super) struct Proof {
    /// How much better it must fit than where odometry leads \[nats an end point\].
    pub(super) gain: f64,
    /// The least share of its end points that are on walls.
    fits: f64,
    /// The largest share that the map disputes.
    disputed: f64,
}

/// Enough of whatever is doubted.
pub(super) const CLEAR: Proof = Proof { gain: 0.3, fits: 0.5, disputed: 0.125 };

/// Enough against odd odometry that errors of the wheels on all of the way do not explain.
pub(super) const ODD: Proof = Proof { gain: 0.05, ..CLEAR };

/// Enough of a robot that is said to stand. People may walk about before it.
pub(super) const STANDING: Proof = Proof { gain: 0.05, fits: 0.8, disputed: 0.05 };

/// Enough of a robot that goes on as before, where the map disputes more than [`REFUTED`] wherever errors that the filter corrects can have led.
pub(super) const GOES_ON: Proof = Proof { gain: 0.2, fits: 0.3, disputed: 1.0 };
pub(super) const REFUTED: f64 = 0.75;

/// Enough of a robot that goes on as before, against odd odometry: that it fits there at least as well.
pub(super) const STEADILY: Proof = Proof { gain: 0.0, ..CLEAR };

/// Where neither place is proved, a robot goes on as before if the map disputes more than this share of the scan where odometry leads.
pub(super) const DISPUTED: f64 = 0.5;

impl Proof {
    /// Whether a pose that gains this much \[nats an end point\] and agrees so with the map is proved.
    pub(super) fn is_given(&self, gain: f64, found: &Agreement) -> bool {
        gain >= self.gain && found.fits >= self.fits && found.disputed() <= self.disputed
    }
}
