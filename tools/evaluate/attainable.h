// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "evaluate/attainable_options.h"
#include "evaluate/object_scores.h"
#include "evaluate/true_scene.h"

#include "datmo_fusion/common/scan.h"

namespace datmo::evaluation {

/// What an observer who knows which beams end on an object can infer about it.
struct AttainableMotion {
  std::optional<Stamp> detectable;  ///< first scan that distinguishes motion from rest; none: never
  std::vector<Stamp> seen;          ///< stamps of the beams that end on it, one for each
};

/// Returns the observations by the id of each object that moves at some time. All scans since its
/// first beam are used, including those in which it need not be found yet; a scan without a beam on
/// it has no information. `scans`: in order of stamp. See MotionBound for the mathematics.
std::map<std::uint32_t, AttainableMotion> attainableMotions(const std::vector<Scan>& scans,
                                                            const TrueScene& scene,
                                                            const AttainableOptions& options);

/// One object's delay, compared with the minimum that the beams allow.
struct ComparedDelay {
  std::optional<double> attainable;  ///< s, after its first required frame; none: never
  std::optional<double> excess;      ///< s, delay minus attainable; none: not found, or never
  std::optional<double> ratio;  ///< (delay + scan period) / (attainable + scan period): 1 if both
                                ///< delays are 0
  double beams_per_scan = 0.0;  ///< that end on it, from its first to its last required frame
};

/// Of each object, in the order of the objects. `scans` as above.
std::vector<ComparedDelay> compareDelays(const std::vector<ObjectScore>& objects,
                                         const std::map<std::uint32_t, AttainableMotion>& motions,
                                         const std::vector<Scan>& scans);

}  // namespace datmo::evaluation
