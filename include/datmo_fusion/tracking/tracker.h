#pragma once

#include <memory>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo_fusion {

struct TrackerOptions {
  void visit(OptionVisitor& visitor);
};

/// Counts since construction or reset(), for diagnostics.
struct TrackerCounts {
  std::uint64_t objects = 0;           ///< taken in
  std::uint64_t rejected_objects = 0;  ///< not finite, or covariance not positive definite
  std::uint64_t confirmed_tracks = 0;  ///< ids given out
};

/// Follows moving objects over time (thesis 3.3.4).
///
/// Not thread safe; lists in rising stamp order, which the caller ensures (StampGate).
class Tracker {
 public:
  /// Throws OptionError.
  explicit Tracker(const TrackerOptions& options);
  ~Tracker();

  /// Takes the objects of one time, in the vehicle's frame, and the vehicle's pose in the fixed frame
  /// at that time. Returns the confirmed tracks in the fixed frame at that time.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed);

  const TrackerCounts& counts() const;

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo_fusion
