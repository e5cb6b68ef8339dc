//! A path as a message of ROS 2, in an MCAP file.

use super::messages::{Header, Path, PoseStamped, Rigid, Time, to_cdr};
use fastslam::geometry::Pose2;
use fastslam::ops;
use mcap::{WriteOptions, records::MessageHeader};
use std::collections::BTreeMap;
use std::io::Cursor;

/// The frame that the path is in.
const FRAME: &str = "map";

/// `nav_msgs/msg/Path` with all that it is made of, in the words of ROS 2.
const SCHEMA: &str = "\
std_msgs/Header header
geometry_msgs/PoseStamped[] poses
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: geometry_msgs/PoseStamped
std_msgs/Header header
geometry_msgs/Pose pose
================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
";

/// Poses with their times \[s\] as one `nav_msgs/msg/Path` on the topic `/path`, in the frame `map`: an MCAP file that Foxglove shows and
/// `ros2 bag play` plays. Metres, unit quaternions, CDR, no compression.
///
/// # Errors
/// Where the message cannot be made, which no path is known to bring about.
pub fn write_path(path: &[(f64, Pose2)]) -> Result<Vec<u8>, String> {
    let header = |time: f64| Header { stamp: Time::of(time), frame_id: FRAME.into() };
    let pose = |(time, Pose2 { x, y, theta }): &(f64, Pose2)| {
        let (sin, cos) = ops::sin_cos(0.5 * theta);
        PoseStamped {
            header: header(*time),
            pose: Rigid { position: [*x, *y, 0.0], orientation: [0.0, 0.0, sin, cos] },
        }
    };
    let last = path.last().map_or(0.0, |(time, _)| *time);
    let bytes = to_cdr(&Path { header: header(last), poses: path.iter().map(pose).collect() })?;
    let Time { sec, nanosec } = Time::of(last);
    let log_time = u64::try_from(sec).unwrap_or(0) * 1_000_000_000 + u64::from(nanosec);
    let write = || -> mcap::McapResult<Vec<u8>> {
        let options = WriteOptions::new().compression(None).profile("ros2").library("fastslam");
        let mut writer = options.create(Cursor::new(Vec::new()))?;
        let schema = writer.add_schema("nav_msgs/msg/Path", "ros2msg", SCHEMA.as_bytes())?;
        let channel_id = writer.add_channel(schema, "/path", "cdr", &BTreeMap::new())?;
        writer.write_to_known_channel(
            &MessageHeader { channel_id, sequence: 0, log_time, publish_time: log_time },
            &bytes,
        )?;
        writer.finish()?;
        Ok(writer.into_inner().into_inner())
    };
    write().map_err(|error| error.to_string())
}
