// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include <datmo_fusion/SignalAdvice.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/earth/signal_advice.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

using SignalAdviceMessage = datmo_fusion::SignalAdvice;
using SignalAdviceMessagePtr = datmo_fusion::SignalAdvicePtr;

struct SignalWireOptions {
  double max_ahead = 0.5;  ///< s
  /// s, 1 to 86400: how long the map of an intersection is valid (ETSI TS 103 301: sent once a
  /// second)
  double map_age = 60.0;
  SignalAdviceOptions advice;

  void visit(OptionVisitor& visitor);
};

/// Traffic lights: stores received SPATEM and MAPEM while they are valid, and computes advice for
/// the vehicle. Counts unusable messages by reason.
class SignalWire {
 public:
  /// `monitor` must outlive it. Throws OptionError.
  SignalWire(const Checked<SignalWireOptions>& options, StageMonitor& monitor);

  /// Whether a datagram is a SPATEM or a MAPEM according to its header.
  static bool accepts(std::string_view bytes);

  /// Processes one of these. `now`: ROS time of arrival; if it is more than a second before that of
  /// the last one, the state is reset.
  void received(std::string_view bytes, Stamp now);

  /// `own`: our tracks on the earth; the one with id 0 is ourselves. Null if we are not in the
  /// list, or not on a lane that leads into a received intersection.
  SignalAdviceMessagePtr advise(const StationTracksMessage& own);

 private:
  struct ReceivedMap {
    Stamp stamp;
    MapIntersection intersection;
  };

  void handleMaps(std::string_view bytes, Stamp now);
  void handleSignals(std::string_view bytes, Stamp now);
  /// Throws InputError (`old_signals`, `future_signals`, `repeated_signals`).
  void keep(const Spatem& message, const SpatIntersection& intersection, Stamp now);
  void forgetOld(Stamp now);
  /// Returns none if the vehicle is on no lane that leads into it.
  std::optional<SignalAdvice> adviseAt(const MapIntersection& intersection,
                                       const ApproachingHost& host, const LocalPlane& plane);

  SignalWireOptions options_;
  StageMonitor& monitor_;
  std::map<IntersectionId, ReceivedMap> maps_;
  std::map<IntersectionId, IntersectionSignals> signals_;
  std::optional<Stamp> last_;
};

}  // namespace datmo
