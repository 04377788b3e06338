"""Small MCAP files with messages of ROS 2, written by the library's own writer."""

from mcap_ros2.writer import Writer

SEPARATOR = "=" * 80
TIME = "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec"
HEADER = "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id"
VECTOR = "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z"
POINT = "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z"
TURN = "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w"
POSE = "MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"
TRANSFORM = "MSG: geometry_msgs/Transform\ngeometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"
STAMPED = (
    "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform"
)


def definition(*parts):
    return f"\n{SEPARATOR}\n".join(parts)


TF = definition("geometry_msgs/TransformStamped[] transforms", STAMPED, TRANSFORM, VECTOR, TURN, HEADER, TIME)
DETECTIONS = definition(
    "std_msgs/Header header\nvision_msgs/Detection3D[] detections",
    "MSG: vision_msgs/Detection3D\nstd_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
    "vision_msgs/BoundingBox3D bbox\nstring id",
    "MSG: vision_msgs/ObjectHypothesisWithPose\nvision_msgs/ObjectHypothesis hypothesis\ngeometry_msgs/PoseWithCovariance pose",
    "MSG: vision_msgs/ObjectHypothesis\nstring class_id\nfloat64 score",
    "MSG: geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance",
    "MSG: vision_msgs/BoundingBox3D\ngeometry_msgs/Pose center\ngeometry_msgs/Vector3 size",
    POSE, POINT, VECTOR, TURN, HEADER, TIME,
)  # fmt: skip
NO_TURN = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}


def stamp(t):
    return {"sec": int(t), "nanosec": round((t - int(t)) * 1e9)}


def header(t, frame):
    return {"stamp": stamp(t), "frame_id": frame}


def xyz(place):
    return dict(zip("xyz", place))


def transform(t, parent, child, place, turn=NO_TURN):
    return {
        "header": header(t, parent),
        "child_frame_id": child,
        "transform": {"translation": xyz(place), "rotation": turn},
    }


def pose(place):
    return {"position": xyz(place), "orientation": NO_TURN}


def detection(t, frame, label, place, score=0.9, identifier=""):
    best = {"hypothesis": {"class_id": label, "score": score}, "pose": {"pose": pose(place), "covariance": [0.0] * 36}}
    box = {"center": pose(place), "size": xyz((0.1, 0.1, 0.1))}
    return {"header": header(t, frame), "results": [best], "bbox": box, "id": identifier}


class Bag:
    """A file that is being written: transforms, detections, and messages that nobody reads."""

    def __init__(self, path, **options):
        self.path, self._stream = path, path.open("wb")
        self.writer = Writer(self._stream, **options)
        self._tf = self.writer.register_msgdef("tf2_msgs/msg/TFMessage", TF)
        self._seen = self.writer.register_msgdef("vision_msgs/msg/Detection3DArray", DETECTIONS)
        self._text = self.writer.register_msgdef("std_msgs/msg/String", "string data")

    def tf(self, t, *transforms, topic="/tf"):
        self.writer.write_message(topic, self._tf, {"transforms": list(transforms)}, log_time=int(t * 1e9))

    def seen(self, t, frame, *detections):
        said = {"header": header(t, frame), "detections": list(detections)}
        self.writer.write_message("/detections", self._seen, said, log_time=int(t * 1e9))

    def text(self, t, data):
        self.writer.write_message("/chatter", self._text, {"data": data}, log_time=int(t * 1e9))

    def close(self):
        self.writer.finish()
        self._stream.close()
        return self.path
