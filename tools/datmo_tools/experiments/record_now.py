# SPDX-License-Identifier: BSD-3-Clause
"""Records messages on topics of the running stack with arrival and stamp; of tracks the positions.

usage: record_now OUT.json

Ends after its standard input has ended, when nothing arrives any more. Times are s of the
computer's clock.
"""

import json
import sys
import time
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticArray

from datmo_fusion.msg import ObjectArray, RiskArray, TrackArray
from datmo_tools.experiments.machines_run import track_positions
from datmo_tools.whole_files import write_file

QUEUE = 200
SILENCE = 5.0  # s
POLL = 0.1  # s
TOPICS = {"tracks": TrackArray, "risks": RiskArray, "objects/stereo": ObjectArray, "objects": ObjectArray}


class Recorder:
    """What has arrived: [stamp, arrival, tracks] by topic, and the reports of `stack`."""

    def __init__(self):
        self.messages = {topic: [] for topic in TOPICS}
        self.stack = []
        self.last = time.time()
        for topic, kind in TOPICS.items():
            rospy.Subscriber(topic, kind, self._take, topic, queue_size=QUEUE, tcp_nodelay=True)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._diagnose, queue_size=QUEUE)

    def _take(self, message, topic):
        self.last = time.time()
        self.messages[topic].append((message.header.stamp.to_sec(), self.last, track_positions(message)))

    def _diagnose(self, message):
        for status in message.status:
            if status.name.startswith("stack:"):
                self.stack.append((time.time(), status.message, {value.key: value.value for value in status.values}))


def main():
    """Returns the exit code."""
    out = Path(sys.argv[1])
    rospy.init_node("record_now", anonymous=True, disable_signals=True)
    recorder = Recorder()
    sys.stdin.read()
    while time.time() - recorder.last < SILENCE:
        time.sleep(POLL)
    write_file(out, json.dumps({"messages": recorder.messages, "stack": recorder.stack}))
    return 0
