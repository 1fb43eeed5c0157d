#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackCombinationOptions {
  static constexpr char kCovarianceIntersection[] = "covariance_intersection";
  static constexpr char kBarShalomCampo[] = "bar_shalom_campo";
  static constexpr char kInformation[] = "information";

  std::string method = kCovarianceIntersection;

  void visit(OptionVisitor& visitor);
};

/// E[(a - x) (b - x)'] of two estimates of one state.
using CrossCovariance = TrackCovariance;

/// Two trackers' estimates of one object at one time, fused.
///
/// They share the object's process noise, so that their errors are correlated (Bar-Shalom 1981).
/// covariance_intersection: consistent whatever the correlation is (Julier & Uhlmann 1997), the
/// weight by least trace/determinant. bar_shalom_campo: by the cross-covariance (Bar-Shalom & Campo
/// 1986). information: as if they were independent; over-confident.
///
/// Both covariances positive definite. Symmetric.
StateEstimate fusedState(const StateEstimate& a, const StateEstimate& b,
                         const CrossCovariance& cross, const TrackCombinationOptions& options);

/// Two tracks at one time, taken for one object: state by fusedState; the box's size and heading,
/// class, height from both; `sensors` and `sources` of both. Id, existence, age and history are a's.
Track combined(const Track& a, const Track& b, const CrossCovariance& cross,
               const TrackCombinationOptions& options);

}  // namespace datmo
