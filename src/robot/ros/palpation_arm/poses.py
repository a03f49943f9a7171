"""Places and rotations as plain lists: x, y, z in metres, and unit quaternions x, y, z, w."""

import math


def plus(place, direction, factor=1.0):
    return [a + factor * b for a, b in zip(place, direction)]


def minus(place, other):
    return [a - b for a, b in zip(place, other)]


def dot(one, other):
    return sum(a * b for a, b in zip(one, other))


def norm(vector):
    return math.sqrt(dot(vector, vector))


def unit(vector):
    """Throws ZeroDivisionError for a vector without a direction."""
    length = norm(vector)
    return [a / length for a in vector]


def rotate(quaternion, vector):
    x, y, z, w = quaternion
    axis = [x, y, z]
    cross = [y * vector[2] - z * vector[1], z * vector[0] - x * vector[2], x * vector[1] - y * vector[0]]
    along = dot(axis, vector)
    return [2 * along * a + (w * w - dot(axis, axis)) * v + 2 * w * c for a, v, c in zip(axis, vector, cross)]


def turn_between(one, other):
    """Radians; q and -q are one rotation."""
    apart = min(norm(minus(one, other)), norm(plus(one, other)))
    return 4 * math.asin(min(1.0, apart / 2))


def turned(start, goal, fraction):
    """That much of the way, on the shorter arc."""
    if dot(start, goal) < 0:
        goal = [-a for a in goal]
    half = turn_between(start, goal) / 2
    if half < 1e-9 or fraction >= 1:
        return list(goal)
    first, second = math.sin((1 - fraction) * half), math.sin(fraction * half)
    return unit([first * a + second * b for a, b in zip(start, goal)])


def on_the_way(start, goal, most_m, most_rad):
    """The pose (position, quaternion) so far from `start` towards `goal` at most: the goal itself where it is near enough."""
    distance, turn = norm(minus(goal[0], start[0])), turn_between(start[1], goal[1])
    share = min(1.0, most_m / distance if distance > 0 else 1.0)
    turn_share = min(1.0, most_rad / turn if turn > 0 else 1.0)
    position = list(goal[0]) if share == 1.0 else plus(start[0], minus(goal[0], start[0]), share)
    return position, list(goal[1]) if turn_share == 1.0 else turned(start[1], goal[1], turn_share)
