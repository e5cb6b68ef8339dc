//! A clock that was set back while a log was recorded.

use super::{LaserLog, Remark};

/// Most that a message is late over a network \[s\]: stamps that go back by more, and stay there, are of a clock that was set back.
const LATE: f64 = 1.0;

/// Most messages in a row that are late by more.
const MOST_LATE: usize = 5;

/// That a clock was set back.
#[derive(Clone, Copy)]
struct SetBack {
    /// The first message after it.
    first: usize,
    /// By how much \[s\], as if this message had come as long after the one before it as messages usually do.
    by: f64,
}

/// Lets the clock of a log run on where it was set back, so that scans and odometry keep the order in which they were recorded. Both must tell
/// of it: where one of them alone goes back, its messages were late.
pub(super) fn run_on(log: &mut LaserLog) {
    let stamps: Vec<f64> = log.scans.iter().map(|scan| scan.time).collect();
    let of_scans = set_backs(&stamps);
    let stamps: Vec<f64> = log.odometry.iter().map(|(time, _)| *time).collect();
    let of_odometry = if stamps.len() > 1 { set_backs(&stamps) } else { of_scans.clone() };
    if of_scans.len() != of_odometry.len() {
        return;
    }
    for (scan, odometry) in of_scans.iter().zip(&of_odometry) {
        // One clock: what comes more often tells more closely by how much.
        let by = odometry.by.min(scan.by);
        let time = log.scans[scan.first - 1].time;
        log.notes.remarks.push(Remark::ClockSetBack { seconds: by, time });
        log.scans[scan.first..].iter_mut().for_each(|scan| scan.time += by);
        if let Some(after) = log.odometry.get_mut(odometry.first..).filter(|_| stamps.len() > 1) {
            after.iter_mut().for_each(|(time, _)| *time += by);
        }
    }
}

/// Where stamps \[s\], in the order of recording, go back by more than messages are late, and go on from there at their usual rate.
fn set_backs(stamps: &[f64]) -> Vec<SetBack> {
    let gaps = stamps.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 0.0);
    let (count, sum) = gaps.fold((0.0, 0.0), |(count, sum), gap| (count + 1.0, sum + gap));
    let usual = sum / f64::max(count, 1.0);
    let (mut found, mut offset, mut latest) = (Vec::new(), 0.0, f64::NEG_INFINITY);
    for (first, stamp) in stamps.iter().enumerate() {
        let back = latest - (stamp + offset);
        if back > LATE {
            let rest = &stamps[first..];
            let before = rest.iter().take_while(|stamp| **stamp + offset < latest).count();
            // Late messages are few; of a clock that was set back all come until it is where it was.
            if before > MOST_LATE && before as f64 >= (0.5 * back / usual).min(rest.len() as f64) {
                let by = back + usual;
                offset += by;
                found.push(SetBack { first, by });
            }
        }
        latest = f64::max(latest, stamp + offset);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stamps of a message each tenth of a second, of which those from the 100th on are changed so.
    fn stamps(changed: impl Fn(usize, f64) -> f64) -> Vec<f64> {
        (0..300).map(|k| (k, 0.1 * k as f64)).map(|(k, t)| if k < 100 { t } else { changed(k, t) }).collect()
    }

    #[test]
    fn a_clock_that_is_set_back_runs_on_and_late_messages_do_not_set_it() {
        let found = set_backs(&stamps(|_, t| t - 10.07));
        assert!(matches!(found[..], [SetBack { first: 100, by }] if (by - 10.07).abs() < 1e-9));
        let twice = set_backs(&stamps(|k, t| if k < 150 { t - 3.0 } else { t - 5.0 }));
        assert!(matches!(twice[..], [SetBack { first: 100, .. }, SetBack { first: 150, .. }]));
        assert!(set_backs(&stamps(|_, t| t + 10.0)).is_empty(), "set forward");
        assert!(set_backs(&stamps(|k, t| if k < 105 { t - 3.0 } else { t })).is_empty(), "five messages are late");
        assert!(set_backs(&stamps(|k, t| if k % 7 == 0 { t - 0.9 } else { t })).is_empty(), "some are a little late");
        assert!(set_backs(&[3.0, 3.0, 1.0]).is_empty() && set_backs(&[]).is_empty());
    }
}
