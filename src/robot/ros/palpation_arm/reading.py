"""What a touch says: a number from the depths and forces that were heard from contact on."""


def slope(depths, forces):
    """Least squares of force over depth, with any force at depth 0. Nothing where all depths are one."""
    count = len(depths)
    depth, force = sum(depths) / count, sum(forces) / count
    spread = sum((one - depth) ** 2 for one in depths)
    if spread == 0.0:
        return None
    return sum((one - depth) * (other - force) for one, other in zip(depths, forces)) / spread


class Felt:
    """Samples of one touch. `kind`: stiffness, N/mm, the slope of force over depth, which a sensor's zero does not change; or force, N, the mean at rest."""

    KINDS = {"stiffness": "N/mm", "force": "N"}

    def __init__(self, kind):
        self.kind = kind
        self.depths_mm, self.forces_n, self.at_rest_n = [], [], []

    def hear(self, depth_m, force_n, is_at_rest):
        self.depths_mm.append(1000 * depth_m)
        self.forces_n.append(force_n)
        if is_at_rest:
            self.at_rest_n.append(force_n)

    def reading(self):
        """None where what was heard is no reading."""
        if len(self.at_rest_n) < 3:
            return None
        return sum(self.at_rest_n) / len(self.at_rest_n) if self.kind == "force" else slope(self.depths_mm, self.forces_n)
