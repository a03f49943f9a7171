"""The messages of CRTK: crtk_msgs where it is installed, else made of the definitions in msg/, which say the same (ROS compares their digests)."""

import importlib
import pathlib

DEFINITIONS = pathlib.Path(__file__).resolve().parent.parent / "msg"


def crtk_message(name):
    """The class of OperatingState or StringStamped. ROS 1 only where it has to be made. Throws ImportError where neither is there."""
    try:
        return getattr(importlib.import_module("crtk_msgs.msg"), name)
    except ImportError:
        return made(name)


def made(name):
    from genpy.dynamic import generate_dynamic
    from std_msgs.msg import Header

    definition = (DEFINITIONS / f"{name}.msg").read_text(encoding="utf-8")
    border = "=" * 80
    return generate_dynamic(f"crtk_msgs/{name}", f"{definition}\n{border}\nMSG: std_msgs/Header\n{Header._full_text}")[f"crtk_msgs/{name}"]
