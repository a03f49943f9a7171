"""crtk.ral where it is installed, else the same few calls on rospy. `ral_of(name, namespace)` is a node in the namespace of an arm."""

import os


class RospyRal:
    """What this package uses of crtk.ral, by its names."""

    def __init__(self, node_name, namespace):
        import rospy

        self.rospy, self.name_space = rospy, "/" + namespace.strip("/")
        rospy.init_node(node_name, anonymous=True, disable_signals=True)

    def namespace(self):
        return self.name_space

    def publisher(self, topic, message, queue_size=10, latch=False):
        return self.rospy.Publisher(f"{self.name_space}/{topic}", message, queue_size=queue_size, latch=latch)

    def subscriber(self, topic, message, callback, queue_size=10, latch=False):  # that a topic is latched ROS 1 knows by itself
        return self.rospy.Subscriber(f"{self.name_space}/{topic}", message, callback, queue_size=queue_size)

    def now(self):
        return self.rospy.Time.now()

    def to_sec(self, stamped):
        stamped = getattr(stamped, "header", stamped)
        return getattr(stamped, "stamp", stamped).to_sec()

    def set_timestamp(self, message):
        message.header.stamp = self.now()
        return message

    def spin(self):
        """rospy's threads run by themselves."""

    def is_shutdown(self):
        return self.rospy.is_shutdown()


def is_ros_1():
    """Said by ROS_VERSION, which Debian leaves unset and crtk wants."""
    return os.environ.setdefault("ROS_VERSION", "1" if os.path.isdir("/usr/lib/python3/dist-packages/rospy") else "2") == "1"


def ral_of(node_name, namespace):
    """Throws ImportError where there is neither crtk nor rospy."""
    is_ros_1()
    try:
        import crtk
    except ImportError:
        return RospyRal(node_name, namespace)
    return crtk.ral(node_name, namespace)
