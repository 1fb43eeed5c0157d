// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/risk/criticality.h"
#include "datmo_fusion/risk/host_futures.h"
#include "datmo_fusion/risk/risk.h"

namespace datmo {

/// The first contact in one of the futures.
struct FutureContact {
  std::size_t future = 0;
  double time = 0.0;  ///< s
  StruckSide side = StruckSide::kNone;
  double speed = 0.0;                ///< m/s, of one body over the other
  Point2 position = Point2::Zero();  ///< m, fixed frame
};

/// Puts probabilities, times and the strike of the futures with contact, `weight` (0 to 1) of
/// `futures` in all, into the risk, and sorts them by time. The struck side is the most frequent
/// one, the speed the median.
void summarize(std::vector<FutureContact>& contacts, std::size_t futures, double weight,
               ObjectRisk& risk);

/// Puts time to brake and threat numbers of an encounter, which goes on evenly, into the risk.
void setCriticality(const Encounter& met, const HostVehicleOptions& vehicle, ObjectRisk& risk);

}  // namespace datmo
