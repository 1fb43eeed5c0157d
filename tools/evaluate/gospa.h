// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "evaluate/matching.h"

#include "datmo_fusion/common/options.h"

namespace datmo::evaluation {

struct GospaOptions {
  double cutoff = 5.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Distance between two sets of points, and its parts; all in m. The squares of the parts add up to
/// the square of the total.
struct Gospa {
  double total = 0.0;
  double localization = 0.0;  ///< of the pairs nearer than the cutoff
  double missed = 0.0;        ///< true objects without a track
  double false_tracks = 0.0;  ///< tracks without a true object
};

/// Generalized optimal sub-pattern assignment metric with p = 2 and alpha = 2 (Rahmathullah,
/// García-Fernández and Svensson, Generalized optimal sub-pattern assignment metric, FUSION 2017)
/// for points in the plane, in m.
Gospa gospa(const std::vector<Point2>& truths, const std::vector<Point2>& tracks,
            const GospaOptions& options);

/// GOSPA of each frame, over the centers of the required truths and of the tracks that are not
/// neutral. Centers are used regardless of what the gate measures, because the distance to a box is
/// not a metric.
std::vector<Gospa> gospaOfFrames(const Frames& frames, const Matching& matching,
                                 const GospaOptions& options);

/// Mean over the frames, separately for each part; none: no frame. Unlike the parts of one frame,
/// the means do not add up.
std::optional<Gospa> meanGospa(const std::vector<Gospa>& frames);

}  // namespace datmo::evaluation
