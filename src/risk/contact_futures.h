// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/risk/criticality.h"
#include "datmo_fusion/risk/host_futures.h"
#include "datmo_fusion/risk/object_futures.h"
#include "datmo_fusion/risk/risk.h"
#include "datmo_fusion/risk/standing_points.h"

namespace datmo {

/// The first contact in one of the futures.
struct FutureContact {
  std::size_t future = 0;
  double time = 0.0;  ///< s
  StruckSide side = StruckSide::kNone;
  double speed = 0.0;                ///< m/s, relative speed
  Point2 position = Point2::Zero();  ///< m, fixed frame
};

/// Returns the first contact of one joint future, step by step: the object's future is sampled no
/// further than needed.
std::optional<FutureContact> contactOf(const BodyPath& host, const BodySize& host_size,
                                       const ObjectFutures& object, const BodySize& size,
                                       std::size_t future);

/// Returns the contact of the host with a stationary point on its path.
FutureContact contactWith(const StandingPoints::Contact& contact, const BodyPath& host,
                          const BodySize& host_size, std::size_t future);

/// Removes futures in which the bodies overlap at the start: nothing has been struck yet, so that
/// their initial state is wrong. Returns how many of `futures` remain possible; all of them, with
/// all contacts, if hardly any is.
std::size_t leaveOutTouching(std::vector<FutureContact>& contacts, std::size_t futures);

/// Writes probabilities, times and impact of the futures with contact to the risk, and sorts the
/// contacts by time. `weight`: 0 to 1, of all `futures` together. The struck side is the most
/// frequent one, the speed the median.
void summarize(std::vector<FutureContact>& contacts, std::size_t futures, double weight,
               ObjectRisk& risk);

/// Writes time to brake and threat numbers of an encounter to the risk; if the host follows the
/// other body, both continue uniformly after the ends of their paths.
void setCriticality(const Encounter& met, const HostVehicleOptions& vehicle, ObjectRisk& risk);

}  // namespace datmo
