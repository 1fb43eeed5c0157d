// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/state_errors.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/angle.h"

namespace datmo::evaluation {

void StateErrorSum::add(const TrueState& truth, const TrackState& track) {
  const double heading =
      std::abs(angleBetween(truth.box.center.heading(), track.box.center.heading()));
  const double heading_modulo_pi = std::min(heading, kPi - heading);
  position_ += (track.box.center.position() - truth.box.center.position()).squaredNorm();
  velocity_ += (track.velocity - truth.velocity).squaredNorm();
  heading_ += heading * heading;
  heading_modulo_pi_ += heading_modulo_pi * heading_modulo_pi;
  ++samples_;
}

StateErrors StateErrorSum::result() const {
  StateErrors errors;
  errors.samples = samples_;
  if (samples_ > 0) {
    const double samples = static_cast<double>(samples_);
    errors.position = std::sqrt(position_ / samples);
    errors.velocity = std::sqrt(velocity_ / samples);
    errors.heading = std::sqrt(heading_ / samples);
    errors.heading_modulo_pi = std::sqrt(heading_modulo_pi_ / samples);
  }
  return errors;
}

StateErrors scoreStateErrors(const Frames& frames, const Matching& matching) {
  StateErrorSum sum;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    forEachHit(frames[i], matching[i],
               [&sum](const TrueState& truth, const TrackState& track) { sum.add(truth, track); });
  }
  return sum.result();
}

StateErrors scoreNearErrors(const Frames& frames, const Matching& matching,
                            const std::vector<Point2>& positions, double range) {
  StateErrorSum sum;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    forEachHit(frames[i], matching[i], [&](const TrueState& truth, const TrackState& track) {
      if ((truth.box.center.position() - positions[i]).norm() <= range) {
        sum.add(truth, track);
      }
    });
  }
  return sum.result();
}

}  // namespace datmo::evaluation
