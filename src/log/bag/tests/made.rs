//! Bags in the making: what is in them, message by message.

use super::read;
use crate::LaserLog;
use crate::bag::messages::{Header, LaserScan, Rigid, Time, Transform, to_cdr};
use mcap::WriteOptions;
use mcap::records::MessageHeader;
use std::collections::BTreeMap;
use std::io::Cursor;

pub const ROBOT_AT: Rigid = Rigid { position: [0.0; 3], orientation: [0.0, 0.0, 0.0, 1.0] };

/// A bag in the making.
pub struct Made {
    writer: mcap::Writer<Cursor<Vec<u8>>>,
}

impl Made {
    pub fn new() -> Self {
        Self { writer: WriteOptions::new().compression(None).create(Cursor::new(Vec::new())).unwrap() }
    }

    pub fn raw(mut self, topic: &str, kind: &str, encoding: &str, bytes: &[u8]) -> Self {
        let schema = self.writer.add_schema(kind, "ros2msg", b"").unwrap();
        let channel_id = self.writer.add_channel(schema, topic, encoding, &BTreeMap::new()).unwrap();
        let header = MessageHeader { channel_id, sequence: 0, log_time: 77_500_000_000, publish_time: 0 };
        self.writer.write_to_known_channel(&header, bytes).unwrap();
        self
    }

    pub fn scan(self, topic: &str, sec: i32, change: impl Fn(&mut LaserScan)) -> Self {
        let header = Header { stamp: Time { sec, nanosec: 0 }, frame_id: "laser".into() };
        let mut scan = LaserScan {
            header,
            angle_min: -0.5,
            angle_increment: 0.25,
            range_min: 0.1,
            range_max: 30.0,
            ..LaserScan::default()
        };
        scan.ranges = vec![1.0, 2.0, 3.0, 4.0, 5.0];
        change(&mut scan);
        self.raw(topic, "sensor_msgs/msg/LaserScan", "cdr", &to_cdr(&scan).unwrap())
    }

    pub fn odometry(self, topic: &str, sec: i32, x: f64) -> Self {
        let header = Header { stamp: Time { sec, nanosec: 0 }, frame_id: "odom".into() };
        let parent_from_child = Rigid { position: [x, 0.0, 0.0], ..ROBOT_AT };
        let message = Transform { header, child_frame_id: "base_link".into(), parent_from_child };
        self.raw(topic, "nav_msgs/msg/Odometry", "cdr", &to_cdr(&message).unwrap())
    }

    pub fn fixed(self, parent: &str, child: &str, parent_from_child: Rigid) -> Self {
        let header = Header { frame_id: parent.into(), ..Header::default() };
        let transform = Transform { header, child_frame_id: child.into(), parent_from_child };
        self.raw("/tf_static", "tf2_msgs/msg/TFMessage", "cdr", &to_cdr(&vec![transform]).unwrap())
    }

    pub fn moving(self, parent: &str, child: &str, sec: i32, x: f64) -> Self {
        let header = Header { stamp: Time { sec, nanosec: 0 }, frame_id: parent.into() };
        let parent_from_child = Rigid { position: [x, 0.0, 0.0], ..ROBOT_AT };
        let transform = Transform { header, child_frame_id: child.into(), parent_from_child };
        self.raw("/tf", "tf2_msgs/msg/TFMessage", "cdr", &to_cdr(&vec![transform]).unwrap())
    }

    pub fn bytes(mut self) -> Vec<u8> {
        self.writer.finish().unwrap();
        self.writer.into_inner().into_inner()
    }

    pub fn read(self) -> Result<LaserLog, String> {
        read(&self.bytes())
    }
}

/// Two scans of a laser that sits 0.2 m ahead on a robot, under a frame for its odometry and a map.
pub fn framed(odom: &str, robot: &str) -> Made {
    let made = Made::new().fixed(robot, "laser", Rigid { position: [0.2, 0.0, 0.0], ..ROBOT_AT });
    [1, 2].into_iter().fold(made, |made, sec| {
        let x = f64::from(sec);
        made.moving("map", odom, sec, 0.1 * x).moving(odom, robot, sec, x).moving(robot, "wheel", sec, 7.0 * x).scan(
            "/scan",
            sec,
            |_| (),
        )
    })
}
