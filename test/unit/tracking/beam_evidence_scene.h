// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scan_history_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/motion_likelihood.h"

namespace datmo::samples {

/// Scans and observations of one object, and the evidence of beams for its motion.
class BeamEvidenceScene : public testing::Test {
 protected:
  /// The results worked out by hand below assume these values, not the defaults.
  BeamEvidenceScene() {
    options_.detection = 0.8;
    options_.detection_strength = 10.0;
    options_.echo_detection = 0.6;
    options_.background = 0.1;
  }

  /// A scan `seconds` after the start, with ends of beams at these positions.
  void scan(double seconds, const std::vector<Point2>& ends) {
    history_.add(scanOf(ends, seconds));
  }

  void see(double seconds, const std::vector<Point2>& points) {
    Object object;
    object.points = points;  // in the fixed frame
    seen_.add(object, seconds, options_.window);
  }

  BeamEvidence evidence(double seconds, const MovingBody& body) const {
    return beamEvidence(history_, seen_, body, Stamp::fromSeconds(100.0 + seconds), seconds,
                        options_);
  }

  /// A body that never covered (20, 0), for certain.
  static MovingBody elsewhere() { return {{Pose2(40.0, 20.0, 0.0), 4.0, 2.0}}; }

  MotionLikelihoodOptions options_;
  ScanHistory history_{ScanHistoryOptions{}};
  SeenPointHistory seen_;
};

}  // namespace datmo::samples
