"""ROS fills its message class from the markers: every sphere a marker, its scale the diameter."""
import io

import genpy
import yaml
from visualization_msgs.msg import Marker, MarkerArray


def check(folder, truth):
    message = MarkerArray()
    genpy.message.fill_message_args(message, [yaml.safe_load((folder / "model.markers").read_text())])
    packed = io.BytesIO()
    message.serialize(packed)
    received = MarkerArray().deserialize(packed.getvalue())
    found, names = {}, set()
    for marker in received.markers:
        assert marker.type == Marker.SPHERE and marker.action == Marker.ADD and marker.color.a > 0, marker
        assert marker.scale.x == marker.scale.y == marker.scale.z and marker.pose.orientation.w == 1, marker
        assert (marker.ns, marker.id) not in names, f"{marker.ns} {marker.id} is given twice"
        names.add((marker.ns, marker.id))
        at = marker.pose.position
        found.setdefault(marker.header.frame_id, []).append([at.x, at.y, at.z, marker.scale.x / 2])
    assert found == truth["spheres"], found
    return f"{len(received.markers)} markers of {len(found)} links"
