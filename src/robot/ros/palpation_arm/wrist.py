"""The joints of a PSM whose wrist has no offsets: yaw, pitch, insertion, roll, and two of the wrist. Its tip is a free flange within their limits.

The base frame is that of the remote centre: x right, y away, z up; at zero the shaft points down. Rotations are quaternions x, y, z, w.
"""

import math

from palpation_arm.poses import norm

NAMES = ["outer_yaw", "outer_pitch", "outer_insertion", "outer_roll", "outer_wrist_pitch", "outer_wrist_yaw"]
LEAST = [-1.6, -0.93, 0.0, -4.5, -1.4, -1.4]
MOST = [1.6, 0.93, 0.24, 4.5, 1.4, 1.4]
FASTEST = [math.pi / 2, math.pi / 2, 0.2, math.pi / 2 * 4, math.pi / 2 * 4, math.pi / 2 * 4]  # rad/s, m/s


def times(one, other):
    ax, ay, az, aw = one
    bx, by, bz, bw = other
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


def about(axis, angle):
    quaternion = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    quaternion[axis] = math.sin(angle / 2)
    return quaternion


def shaft(joints):
    """Its rotation: z along it, towards the tip."""
    return times(times(about(1, joints[0]), about(0, joints[1])), [1.0, 0.0, 0.0, 0.0])


def pose_of(joints):
    """Position and quaternion of the tip."""
    yaw, pitch, insertion = joints[:3]
    position = [-insertion * math.sin(yaw) * math.cos(pitch), insertion * math.sin(pitch), -insertion * math.cos(yaw) * math.cos(pitch)]
    wrist = times(times(about(2, joints[3]), about(1, joints[4])), about(0, joints[5]))
    return position, times(shaft(joints), wrist)


def joints_of(position, quaternion):
    """None where no joints within their limits reach the pose."""
    insertion, length = norm(position), norm(quaternion)
    if not (math.isfinite(insertion) and insertion > 1e-6 and math.isfinite(length) and length > 0.5):
        return None
    quaternion = [a / length for a in quaternion]
    yaw, pitch = math.atan2(-position[0], -position[2]), math.asin(max(-1.0, min(1.0, position[1] / insertion)))
    back = shaft([yaw, pitch])
    x, y, z, w = times([-back[0], -back[1], -back[2], back[3]], quaternion)
    roll = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    wrist_pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    wrist_yaw = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    joints = [yaw, pitch, insertion, roll, wrist_pitch, wrist_yaw]
    return joints if all(a <= joint <= b for a, joint, b in zip(LEAST, joints, MOST)) else None


def clipped(joints):
    return [max(a, min(b, joint)) for a, joint, b in zip(LEAST, joints, MOST)]


def towards(joints, goal, seconds, ratio=1.0):
    """As far as the speeds of the joints allow, each by itself, as a servo goes."""
    return [now + max(-ratio * fastest * seconds, min(ratio * fastest * seconds, then - now)) for now, then, fastest in zip(joints, goal, FASTEST)]


def together(joints, goal, seconds, ratio=1.0):
    """The same, all joints arriving at once, as a trajectory goes."""
    longest = max(abs(then - now) / fastest for now, then, fastest in zip(joints, goal, FASTEST))
    share = 1.0 if longest <= ratio * seconds else ratio * seconds / longest
    return list(goal) if share == 1.0 else [now + share * (then - now) for now, then in zip(joints, goal)]
