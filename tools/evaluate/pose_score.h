// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evaluate/consistency.h"
#include "evaluate/trajectory.h"

namespace datmo::evaluation {

/// Mean error of the motion between poses that are this far apart on the true path.
struct RelativePoseError {
  double distance = 0.0;              ///< m
  std::optional<double> translation;  ///< m; none: the path is shorter
  std::optional<double> rotation;     ///< rad
  std::size_t pairs = 0;
};

/// Accuracy of the estimated pose of the vehicle; the maps are aligned at the first pose. Every
/// estimated pose whose truth is known is scored.
struct PoseScore {
  double end_error = 0.0;           ///< m, at the last pose
  double end_heading_error = 0.0;   ///< rad, 0 to pi
  double path_length = 0.0;         ///< m, true, from the first to the last pose
  std::optional<double> end_share;  ///< end error by path length; none: stationary
  double position_rmse = 0.0;       ///< m
  double heading_rmse = 0.0;        ///< rad
  double largest_jump = 0.0;        ///< m, see kJumpTime
  std::vector<RelativePoseError> relative;
  Consistency consistency;  ///< x, y and heading
};

/// A jump is the error of the estimated motion within this time, which is short relative to drift,
/// but long relative to a match that is wrong over a few scans.
inline constexpr double kJumpTime = 1.0;  // s

/// Scores the estimate against the truth: end point; root mean square errors; the largest jump; the
/// error of relative poses 10 m and 70 m apart (Kuemmerle et al., On measuring the accuracy of SLAM
/// algorithms, Autonomous Robots 27(4), 2009, equation 4, with the true poses as relations); NEES
/// (Bar-Shalom, Li and Kirubarajan 2001, section 5.4). Returns none if the two do not overlap.
std::optional<PoseScore> scorePoses(const Trajectory& estimated, const Trajectory& truth);

}  // namespace datmo::evaluation
