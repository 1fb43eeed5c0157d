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
  double speed = 0.0;                ///< m/s, of one body over the other
  Point2 position = Point2::Zero();  ///< m, fixed frame
};

/// First contact of one joint future, step by step: the object's is drawn no further than needed.
std::optional<FutureContact> contactOf(const BodyPath& host, const BodySize& host_size,
                                       const ObjectFutures& object, const BodySize& size,
                                       std::size_t future);

/// A point that stands, on the path of the host.
FutureContact contactWith(const StandingPoints::Contact& contact, const BodyPath& host,
                          const BodySize& host_size, std::size_t future);

/// Nothing has been struck yet: a future in which the bodies overlap at its start is of a wrong
/// state, and is left out. Returns how many of `futures` are possible then; all of them, with all
/// contacts, if hardly any is.
std::size_t leaveOutTouching(std::vector<FutureContact>& contacts, std::size_t futures);

/// Puts probabilities, times and the strike of the futures with contact, `weight` (0 to 1) of
/// `futures` in all, into the risk, and sorts them by time. The struck side is the most frequent
/// one, the speed the median.
void summarize(std::vector<FutureContact>& contacts, std::size_t futures, double weight,
               ObjectRisk& risk);

/// Puts time to brake and threat numbers of an encounter into the risk; where the host pursues what
/// it meets, both go on evenly after the paths' ends.
void setCriticality(const Encounter& met, const HostVehicleOptions& vehicle, ObjectRisk& risk);

}  // namespace datmo
