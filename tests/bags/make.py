"""Writes the bags of this folder, and the CARMEN log that says the same, out of the simulated log of the figures' tests.

    pip install rosbags mcap-ros2-support lz4 mpmath numpy
    python tests/bags/make.py

The bags come from two independent writers, `rosbags` and `mcap-ros2-support`. So that a path can be the same to the last bit, all say the
same numbers: ranges and angles are those of single precision, with all the decimals that
tell them apart, and each heading of the log is one that has a quaternion,
of nearly unit length, whose heading is the same to a twentieth of its last bit: however a library rounds, it comes out.
"""

import random
import re
import sqlite3
import tempfile
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap_ros2.writer import Writer as McapWriter
from mpmath import atan2, cos, mp, mpf, sin
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

mp.prec = 200
here = Path(__file__).parent
source = here.parent / "figures" / "golden" / "tiny.clf"
MOST = 30  # scans: enough of a lap, and small files
STEP = float(np.float32(0.052359878))
MAX = 8.0

HEADER = "std_msgs/Header header\n"
OF_HEADER = "================================================================================\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n================================================================================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
SCAN = HEADER + "".join(f"float32 {name}\n" for name in "angle_min angle_max angle_increment time_increment scan_time range_min range_max".split()) + "float32[] ranges\nfloat32[] intensities\n" + OF_HEADER


def quaternion(theta):
    """z and w with 2 atan2(z, w) = theta; None where there are none."""
    half = mpf(theta) / 2
    draws = random.Random(repr(theta))
    near = lambda exact, number: not number or abs(exact - mpf(number)) <= mpf(float(np.spacing(abs(number)))) / 20
    for _ in range(1000):
        length = 1 + mpf(draws.uniform(-1e-7, 1e-7))
        z, w = float(sin(half) * length), float(cos(half) * length)
        # The quotient as well, from which libraries compute the angle.
        if near(mpf(z) / mpf(w), z / w) and near(2 * atan2(mpf(z), mpf(w)), theta):
            return z, w
    return None


def heading(theta):
    """The next heading, in steps of a millionth, that has a quaternion."""
    steps = (round(theta + 1e-6 * k, 6) for k in range(1000))
    return next(theta for theta in steps if quaternion(theta))


def scans():
    """Time in ns, ranges, pose."""
    for line in source.read_text().splitlines():
        words = line.split()
        if words[:1] != ["ROBOTLASER1"]:
            continue
        count = int(words[8])
        ranges = np.array([float(word) for word in words[9 : 9 + count]], dtype=np.float32)
        rest = words[9 + count + 1 :]
        x, y, theta = (float(word) for word in rest[3:6])
        seconds, decimals = re.fullmatch(r"(\d+)\.?(\d*)", rest[11]).groups()
        yield int(seconds) * 10**9 + int((decimals + "0" * 9)[:9]), ranges, (x, y, heading(theta))


def carmen(log):
    yield "# A simulated lap, written by tests/bags/make.py.\n"
    for time, ranges, (x, y, theta) in log:
        pose = f"{x!r} {y!r} {theta!r}"
        numbers = " ".join(str(r) for r in ranges)
        stamp = f"{time // 10**9}.{time % 10**9:09d}"
        yield f"ROBOTLASER1 0 0 6.283185 {STEP!r} {MAX} 0.01 0 {len(ranges)} {numbers} 0 {pose} {pose} 0 0 0 0 0 {stamp} simulated {stamp}\n"


def mcap(path, log, compression, tf):
    """By mcap-ros2-support. With tf, odometry is a transform; else it is nav_msgs/Odometry."""
    vector = "float64 x\nfloat64 y\nfloat64 z\n"
    four = vector + "float64 w\n"
    rule = "=" * 80 + "\n"
    odometry = HEADER + "string child_frame_id\ngeometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n" + OF_HEADER
    for name, fields in {
        "PoseWithCovariance": "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
        "TwistWithCovariance": "geometry_msgs/Twist twist\nfloat64[36] covariance\n",
        "Twist": "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
        "Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
        "Point": vector,
        "Vector3": vector,
        "Quaternion": four,
    }.items():
        odometry += f"{rule}MSG: geometry_msgs/{name}\n{fields}"
    transforms = "geometry_msgs/TransformStamped[] transforms\n" + OF_HEADER
    for name, fields in {
        "TransformStamped": HEADER + "string child_frame_id\ngeometry_msgs/Transform transform\n",
        "Transform": "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
        "Vector3": vector,
        "Quaternion": four,
    }.items():
        transforms += f"{rule}MSG: geometry_msgs/{name}\n{fields}"
    with path.open("wb") as file:
        writer = McapWriter(file, chunk_size=16_000, compression=compression)
        of_scan = writer.register_msgdef("sensor_msgs/msg/LaserScan", SCAN)
        of_odometry = writer.register_msgdef("nav_msgs/msg/Odometry", odometry)
        of_tf = writer.register_msgdef("tf2_msgs/msg/TFMessage", transforms)
        nothing = {"x": 0.0, "y": 0.0, "z": 0.0}

        def transform(stamp, parent, child, x, y, z, w):
            header = {"stamp": stamp, "frame_id": parent}
            return {"header": header, "child_frame_id": child, "transform": {"translation": {"x": x, "y": y, "z": 0.0}, "rotation": {"x": 0.0, "y": 0.0, "z": z, "w": w}}}

        first = log[0][0]
        zero = {"sec": 0, "nanosec": 0}
        writer.write_message("/tf_static", of_tf, {"transforms": [transform(zero, "base_link", "laser", 0.0, 0.0, 0.0, 1.0)]}, first, first)
        for time, ranges, (x, y, theta) in log:
            stamp = {"sec": time // 10**9, "nanosec": time % 10**9}
            z, w = quaternion(theta)
            if tf:
                writer.write_message("/tf", of_tf, {"transforms": [transform(stamp, "odom", "base_link", x, y, z, w)]}, time, time)
            else:
                pose = {"position": {"x": x, "y": y, "z": 0.0}, "orientation": {"x": 0.0, "y": 0.0, "z": z, "w": w}}
                twist = {"twist": {"linear": nothing, "angular": nothing}, "covariance": [0.0] * 36}
                message = {"header": {"stamp": stamp, "frame_id": "odom"}, "child_frame_id": "base_link", "pose": {"pose": pose, "covariance": [0.0] * 36}, "twist": twist}
                writer.write_message("/wheels/odom", of_odometry, message, time, time)
            message = {"header": {"stamp": stamp, "frame_id": "laser"}, "angle_min": 0.0, "angle_max": STEP * (len(ranges) - 1), "angle_increment": STEP, "time_increment": 0.0}
            message |= {"scan_time": 0.1, "range_min": 0.0, "range_max": MAX, "ranges": [float(r) for r in ranges], "intensities": []}
            writer.write_message("/scan", of_scan, message, time, time)
        writer.finish()


def ros1(path, log, compression):
    """By rosbags."""
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", "tf2_msgs/msg/TFMessage"))
    kinds = store.types
    time_of = lambda time: kinds["builtin_interfaces/msg/Time"](sec=time // 10**9, nanosec=time % 10**9)
    header = lambda time, frame: kinds["std_msgs/msg/Header"](seq=7, stamp=time_of(time), frame_id=frame)
    vector = lambda x, y: kinds["geometry_msgs/msg/Vector3"](x=x, y=y, z=0.0)
    turn = lambda z, w: kinds["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=z, w=w)
    path.unlink(missing_ok=True)
    writer = Ros1Writer(path)
    if compression:
        writer.set_compression(compression)
    with writer:
        connection = {topic: writer.add_connection(topic, kind, typestore=store) for topic, kind in {"/scan": "sensor_msgs/msg/LaserScan", "/odom": "nav_msgs/msg/Odometry", "/tf": "tf2_msgs/msg/TFMessage"}.items()}

        def write(topic, time, message):
            writer.write(connection[topic], time, store.serialize_ros1(message, message.__msgtype__))

        for time, ranges, (x, y, theta) in log:
            pose = kinds["geometry_msgs/msg/Pose"](position=kinds["geometry_msgs/msg/Point"](x=x, y=y, z=0.0), orientation=turn(*quaternion(theta)))
            twist = kinds["geometry_msgs/msg/Twist"](linear=vector(0.0, 0.0), angular=vector(0.0, 0.0))
            none = np.zeros(36)
            # As static_transform_publisher of ROS 1 has it.
            mounting = kinds["geometry_msgs/msg/Transform"](translation=vector(0.0, 0.0), rotation=turn(0.0, 1.0))
            stamped = kinds["geometry_msgs/msg/TransformStamped"](header=header(time, "/base_link"), child_frame_id="/laser", transform=mounting)
            write("/tf", time, kinds["tf2_msgs/msg/TFMessage"](transforms=[stamped]))
            write("/odom", time, kinds["nav_msgs/msg/Odometry"](header=header(time, "odom"), child_frame_id="base_link", pose=kinds["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=none), twist=kinds["geometry_msgs/msg/TwistWithCovariance"](twist=twist, covariance=none)))
            write(
                "/scan",
                time,
                kinds["sensor_msgs/msg/LaserScan"](header=header(time, "laser"), angle_min=0.0, angle_max=STEP * (len(ranges) - 1), angle_increment=STEP, time_increment=0.0, scan_time=0.1, range_min=0.0, range_max=MAX, ranges=ranges, intensities=np.zeros(0, dtype=np.float32)),
            )


def sqlite(path, source):
    """By rosbags, the messages of another bag. Small pages: rows go on in others, and tables have three levels."""
    with tempfile.TemporaryDirectory() as folder:
        bag = Path(folder) / "bag"
        with source.open("rb") as file, Ros2Writer(bag, version=8) as writer:
            store, connections = get_typestore(Stores.ROS2_HUMBLE), {}
            for _, channel, message in make_reader(file).iter_messages(log_time_order=False):
                if channel.topic not in connections:
                    kind = {"/scan": "sensor_msgs/msg/LaserScan", "/wheels/odom": "nav_msgs/msg/Odometry"}.get(channel.topic, "tf2_msgs/msg/TFMessage")
                    connections[channel.topic] = writer.add_connection(channel.topic, kind, typestore=store)
                writer.write(connections[channel.topic], message.log_time, message.data)
        (database,) = bag.glob("*.db3")
        connection = sqlite3.connect(database)
        connection.executescript("PRAGMA page_size = 512; VACUUM")
        connection.close()
        path.write_bytes(database.read_bytes())


def two_lasers(path, log):
    """Two topics of scans, and no odometry."""
    with path.open("wb") as file:
        writer = McapWriter(file, compression=CompressionType.ZSTD)
        of_scan = writer.register_msgdef("sensor_msgs/msg/LaserScan", SCAN)
        for time, ranges, _ in log:
            message = {"header": {"stamp": {"sec": time // 10**9, "nanosec": time % 10**9}, "frame_id": "laser"}, "angle_max": 0.0, "time_increment": 0.0}
            message |= {"scan_time": 0.1, "range_min": 0.0, "range_max": MAX, "intensities": [], "angle_min": 0.0}
            for topic, step in {"/front/scan": 1, "/rear/scan": 2}.items():
                sweep = {"angle_increment": step * STEP, "ranges": [float(r) for r in ranges[::step]]}
                writer.write_message(topic, of_scan, message | sweep, time, time)
        writer.finish()


log = list(scans())[:MOST]
(here / "lap.clf").write_text("".join(carmen(log)))
mcap(here / "odometry-zstd.mcap", log, CompressionType.ZSTD, tf=False)
mcap(here / "tf-lz4.mcap", log, CompressionType.LZ4, tf=True)
sqlite(here / "odometry.db3", here / "odometry-zstd.mcap")
ros1(here / "plain.bag", log, None)
ros1(here / "lz4.bag", log, Ros1Writer.CompressionFormat.LZ4)
ros1(here / "bz2.bag", log, Ros1Writer.CompressionFormat.BZ2)
two_lasers(here / "two-lasers.mcap", log[:3])
