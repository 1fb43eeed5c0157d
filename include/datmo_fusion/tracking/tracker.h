#pragma once

#include <cstdint>
#include <memory>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/duplicates.h"
#include "datmo_fusion/tracking/target.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackerOptions {
  TargetOptions target;
  AssociationOptions association;
  DuplicateOptions duplicates;
  int confirmation_hits = 3;
  double tentative_silence = 0.5;  ///< s
  double confirmed_silence = 3.0;  ///< s
  double published_silence = 1.5;  ///< s
  double most_position_std = 5.0;  ///< m
  int most_targets = 300;

  void visit(OptionVisitor& visitor);
};

/// Counts since construction or reset(), for diagnostics.
struct TrackerCounts {
  std::uint64_t objects = 0;           ///< taken in
  std::uint64_t rejected_objects = 0;  ///< see isValid()
  std::uint64_t confirmed_tracks = 0;  ///< ids given out
  std::uint64_t refused_births = 0;    ///< new objects that found no room
  std::uint64_t merged_tracks = 0;     ///< removed as another view of a confirmed track
};

/// Follows moving objects over time (thesis 3.3.4).
///
/// Every object that is not known as static starts a target, which is followed inside; what is
/// published has been seen several times, evidently moves or has moved (MotionEvidence), and was
/// seen not long ago. A track lives without objects for as long as it was followed with them, up to
/// a limit.
///
/// Not thread safe; lists in rising stamp order, which the caller ensures (StampGate). The order of
/// the objects in a list does not matter.
class Tracker {
 public:
  /// Throws OptionError.
  explicit Tracker(const TrackerOptions& options);
  ~Tracker();

  /// Takes the objects of one time, in the vehicle's frame, and the vehicle's pose in the fixed
  /// frame at that time. Returns the confirmed tracks in the fixed frame at that time.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed);

  const TrackerCounts& counts() const;

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
