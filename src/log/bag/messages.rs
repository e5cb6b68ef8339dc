//! The messages of ROS that are read and written, as far as they are of use, and their two encodings.
//!
//! ROS 2 encodes by CDR: four bytes that tell the order of bytes, then each number at a multiple of its size. ROS 1 packs the same fields
//! without gaps, low bytes first, and begins each header with a number more. What follows the fields named here stays unread.

use crate::MessageProblem;
use crate::number::number;
use byteorder::{BigEndian, LittleEndian};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

/// When \[s\] and \[ns\].
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
pub struct Time {
    pub sec: i32,
    pub nanosec: u32,
}

impl Time {
    /// The double nearest to the stamp written as a decimal \[s\]: what a log in plain text that says the same is read as.
    pub fn seconds(self) -> f64 {
        let Self { sec, nanosec } = self;
        let decimal = number(&format!("{sec}.{nanosec:09}"));
        decimal.filter(|_| sec >= 0 && nanosec < 1_000_000_000).unwrap_or(f64::from(sec) + 1e-9 * f64::from(nanosec))
    }

    /// The stamp nearest to a time \[s\].
    pub fn of(seconds: f64) -> Self {
        let whole = seconds.floor();
        let nanosec = ((seconds - whole) * 1e9).round() as u32;
        Self { sec: whole as i32 + i32::from(nanosec == 1_000_000_000), nanosec: nanosec % 1_000_000_000 }
    }
}

#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Header {
    pub stamp: Time,
    pub frame_id: String,
}

/// `sensor_msgs/LaserScan`, without its intensities.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct LaserScan {
    pub header: Header,
    /// \[rad\]
    pub angle_min: f32,
    pub angle_max: f32,
    pub angle_increment: f32,
    /// \[s\]
    pub time_increment: f32,
    pub scan_time: f32,
    /// \[m\]
    pub range_min: f32,
    pub range_max: f32,
    pub ranges: Vec<f32>,
}

/// Of poses and of transforms: metres, and x y z w.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
pub struct Rigid {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
}

/// `geometry_msgs/TransformStamped`, and the start of `nav_msgs/Odometry`.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Transform {
    /// Its frame is the parent.
    pub header: Header,
    pub child_frame_id: String,
    pub parent_from_child: Rigid,
}

/// `geometry_msgs/PoseStamped`.
#[derive(Serialize)]
pub struct PoseStamped {
    pub header: Header,
    pub pose: Rigid,
}

/// `nav_msgs/Path`.
#[derive(Serialize)]
pub struct Path {
    pub header: Header,
    pub poses: Vec<PoseStamped>,
}

/// A message of ROS 1 that begins with a header: its number comes first.
#[derive(Deserialize)]
struct Numbered<T> {
    _seq: u32,
    message: T,
}

/// How a channel encodes its messages.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Encoding {
    /// ROS 2.
    Cdr,
    /// ROS 1.
    Ros1,
    /// Any other, by its name.
    Other(String),
}

impl Encoding {
    /// A message that begins with a header.
    pub fn one<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<T, MessageProblem> {
        match self {
            Self::Cdr => cdr(bytes),
            _ => self.ros1::<Numbered<T>>(bytes).map(|numbered| numbered.message),
        }
    }

    /// A message that is a list of such.
    pub fn list<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<Vec<T>, MessageProblem> {
        match self {
            Self::Cdr => cdr(bytes),
            _ => Ok(self.ros1::<Vec<Numbered<T>>>(bytes)?.into_iter().map(|numbered| numbered.message).collect()),
        }
    }

    fn ros1<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<T, MessageProblem> {
        if let Self::Other(name) = self {
            return Err(MessageProblem::Encoding(name.clone()));
        }
        let mut decoder = roslibrust_serde_rosmsg::Deserializer::new(bytes, bytes.len() as u32);
        T::deserialize(&mut decoder).map_err(|_| MessageProblem::Short)
    }
}

fn cdr<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, MessageProblem> {
    let (order, body) = bytes.split_at_checked(4).ok_or(MessageProblem::Short)?;
    let read = match order[..2] {
        [0, 0] => cdr_encoding::from_bytes::<T, BigEndian>(body),
        [0, 1] => cdr_encoding::from_bytes::<T, LittleEndian>(body),
        _ => return Err(MessageProblem::Encapsulation([order[0], order[1]])),
    };
    read.map(|(message, _)| message).map_err(|_| MessageProblem::Short)
}

/// A message as ROS 2 encodes it.
pub fn to_cdr(message: &impl Serialize) -> Result<Vec<u8>, String> {
    let mut bytes = vec![0, 1, 0, 0];
    let body = cdr_encoding::to_vec::<_, LittleEndian>(message).map_err(|error| error.to_string())?;
    bytes.extend(body);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_is_the_double_of_its_decimals() {
        for (sec, nanosec, text) in
            [(1, 370_000_000, "1.37"), (1_700_000_000, 123_456_789, "1700000000.123456789"), (0, 1, "1e-9")]
        {
            assert_eq!(Time { sec, nanosec }.seconds(), text.parse::<f64>().unwrap());
        }
        assert_eq!(Time { sec: -1, nanosec: 500_000_000 }.seconds(), -0.5);
        let Time { sec, nanosec } = Time::of(12.999_999_999_9);
        assert_eq!((sec, nanosec), (13, 0));
    }
}
