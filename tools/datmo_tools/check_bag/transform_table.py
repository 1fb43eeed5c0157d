# SPDX-License-Identifier: BSD-3-Clause
"""The tree of frames that a recording publishes on /tf and /tf_static."""

import numpy as np

from datmo_tools import transforms


def bare(frame):
    """Returns a frame's name without tf 1's leading slash."""
    return frame[1:] if frame.startswith("/") else frame


class Edge:
    """Everything that was published from one parent to one child."""

    def __init__(self, static):
        self.static = static
        self.count = 0
        self.matrix = None  # 4 x 4, the first one
        self.moved = 0.0  # m, largest distance from the first one
        self.turned = 0.0  # rad, likewise
        self.stamps = []  # s since the start of the recording
        self.valid = True  # finite, with a quaternion of norm 1

    def add(self, matrix, stamp):
        """Adds one transform; None: not a rigid one."""
        self.count += 1
        if matrix is None:
            self.valid = False
            return
        if self.matrix is None:
            self.matrix = matrix
        self.stamps.append(stamp)
        self.moved = max(self.moved, float(np.linalg.norm(matrix[:3, 3] - self.matrix[:3, 3])))
        change = transforms.rotation_of(self.matrix[:3, :3].T @ matrix[:3, :3])
        self.turned = max(self.turned, float(np.linalg.norm(change.as_rotvec())))


class TransformTable:
    """Edges by (parent, child), both without leading slashes."""

    def __init__(self):
        self.edges = {}
        self.slashed = set()  # frames as written, with their slash

    def add(self, message, static, start):
        """Adds a TFMessage; `start`: of the recording, ns."""
        for item in message.transforms:
            names = item.header.frame_id, item.child_frame_id
            self.slashed.update(name for name in names if name.startswith("/"))
            key = bare(names[0]), bare(names[1])
            edge = self.edges.setdefault(key, Edge(static))
            edge.add(_matrix(item.transform), 1e-9 * (item.header.stamp.to_nsec() - start))

    def parents(self, child):
        """Returns the sorted names of all parents of a frame."""
        return sorted(parent for parent, name in self.edges if name == child)

    def frames(self):
        """Returns the names of all frames."""
        return {name for key in self.edges for name in key}

    def children(self):
        """Returns the names of all frames that have a parent."""
        return sorted({child for _, child in self.edges})

    def ancestors(self, frame):
        """Returns the frame, its parent, and so on, up to a root or until a loop closes."""
        chain = [frame]
        while True:
            parents = self.parents(chain[-1])
            if not parents or parents[0] in chain:
                return chain
            chain.append(parents[0])

    def loops(self):
        """Whether some frame is its own ancestor."""
        for frame in self.frames():
            last = self.ancestors(frame)[-1]
            if self.parents(last):
                return True
        return False

    def between(self, target, source):
        """Returns the 4 x 4 transform from `source` to `target`, by the first ones; or None."""
        up_source, up_target = self.ancestors(source), self.ancestors(target)
        common = next((frame for frame in up_source if frame in up_target), None)
        if common is None:
            return None
        to_common = self._to_ancestor(up_source, common)
        from_target = self._to_ancestor(up_target, common)
        if to_common is None or from_target is None:
            return None
        return transforms.inverse(from_target) @ to_common

    def _to_ancestor(self, chain, ancestor):
        matrix = np.eye(4)
        for child, parent in zip(chain, chain[1:]):
            if child == ancestor:
                break
            edge = self.edges[(parent, child)].matrix
            if edge is None:
                return None
            matrix = edge @ matrix
        return matrix

    def path(self, target, source):
        """Returns the edges of the path between two frames; empty if there is none."""
        up_source, up_target = self.ancestors(source), self.ancestors(target)
        common = next((frame for frame in up_source if frame in up_target), None)
        if common is None:
            return []
        chains = (up_source[: up_source.index(common) + 1], up_target[: up_target.index(common) + 1])
        return [
            self.edges[(parent, child)]
            for chain in chains
            for child, parent in zip(chain, chain[1:])
        ]


def _matrix(transform):
    turn, shift = transform.rotation, transform.translation
    quaternion = np.array([turn.x, turn.y, turn.z, turn.w])
    translation = np.array([shift.x, shift.y, shift.z])
    norm = np.linalg.norm(quaternion)
    if not (np.all(np.isfinite(translation)) and abs(norm - 1.0) < 1e-2):
        return None
    return transforms.rigid_of(transform)
