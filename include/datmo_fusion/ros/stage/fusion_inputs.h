// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/fusion/sync/source_matcher.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

/// What a stage that fuses several sources wants of them.
struct FusionInputOptions {
  std::string frame;  ///< of all messages
  FrameOptions frames;
  std::optional<MotionOptions> motion;  ///< none: `frame` does not move
  StreamOptions input;
  SourceMatcherOptions matcher;
  std::vector<std::string> sources;
  std::string what;  ///< one message of a source is: "grid"
};

/// Things in a message that are not taken in, while the rest of it is.
struct LeftOut {
  std::string reason;  ///< as of an InputError
  std::size_t count = 0;
  std::string what;      ///< "bad views"
  std::string expected;  ///< of such a source
};

/// Throws OptionError for a source whose topic could not be, or would be one of the stage's own.
/// `what`: one message of a source; `own`: the topics that the stage makes itself.
void checkSourceNames(const std::vector<std::string>& sources, const std::string& what,
                      const std::set<std::string>& own);

/// Input check of a stage that fuses several sources: which messages are let in, what time it is,
/// how the vehicle moved, and which source is missed.
///
/// A source that falls silent is said once
/// until it is fused again, and so is one that for as long is always too late or whose motion is
/// not known.
///
/// The reference's stamps are the ones that hold: while it publishes, a message of another source
/// that is ahead of them by more than `silent_after` is refused (`stamp_ahead`), for a clock that
/// is ahead would make the reference look silent.
///
/// Time is the data's: that of the newest message, and from its arrival on as much later as the
/// caller's clock says. So the two clocks need not agree.
class FusionInputs {
 public:
  /// `runner`: of the stage, which is to call reset() when it is reset itself; it must outlive the
  /// inputs. Throws OptionError.
  FusionInputs(const FusionInputOptions& options, StageRunner& runner);

  /// One message of a source. `now`: ROS time. Throws InputError: `unknown_source`, `wrong_frame`,
  /// `stamp_ahead` and those of StageRunner::check.
  void take(const std::string& source, const std_msgs::Header& header, Stamp now);

  /// Newest motion, as MotionInput reads it; bad one is dropped through the monitor. Only where the
  /// options ask for motion (else std::bad_optional_access). `Message`: nav_msgs::Odometry or
  /// geometry_msgs::PoseWithCovarianceStamped.
  template <typename Message>
  void takeMotion(const Message& message) {
    runner_.serve([&] { motion_.value().take(message); });
  }

  /// Forgets everything.
  void reset();

  /// What a message of this source has that cannot be used, if there is any: warns and keeps count.
  void report(const std::string& source, const LeftOut& left_out);

  /// The next set of the stage's matcher; none if nothing is ready. `now`: ROS time.
  template <typename Matcher>
  auto nextOf(Matcher& matcher, Stamp now) const -> decltype(matcher.next(now)) {
    const std::optional<Stamp> time = dataTime(now);
    return time ? matcher.next(*time) : std::nullopt;
  }

  /// The first set of the stage's matcher that waits for others and is newer than `newest`, with
  /// what has come until now; none if there is none. `now`: ROS time.
  template <typename Payload>
  std::optional<MatchedSamples<Payload>> earlyOf(const SourceMatcher<Payload>& matcher,
                                                 const std::optional<Stamp>& newest,
                                                 Stamp now) const {
    const std::optional<Stamp> time = dataTime(now);
    return time ? matcher.early(newest, *time) : std::nullopt;
  }

  /// The motion of the messages' frame, the vehicle's, from one stamp to a later one; none if it is
  /// not known. Only where the options ask for motion (else std::bad_optional_access).
  std::optional<Pose2> motion(Stamp from, Stamp to) const {
    return motion_.value().between(from, to);
  }

  /// What was fused at this stamp was without these sources: warns and keeps count.
  void report(Stamp stamp, const std::vector<MissingSource>& missing);

  /// How many lists of each source were in no set, as figures.
  template <typename Payload>
  void reportUnserved(const SourceMatcher<Payload>& matcher) {
    for (const std::string& source : options_.sources) {
      runner_.monitor().figure("lists of " + source + " not fused",
                               static_cast<double>(matcher.unserved(source)));
    }
  }

 private:
  /// A message's arrival; `came`: on the caller's clock.
  struct Arrived {
    Stamp stamp;
    Stamp came;
  };

  /// Of a source that the last set was without.
  struct Absence {
    Stamp since;                ///< stamp of the first set without it
    std::set<WhyMissing> said;  ///< reasons that have been warned of
  };

  void checkAhead(const std::string& source, Stamp stamp, Stamp now) const;

  /// Time of the data at this ROS time; none before the first message.
  std::optional<Stamp> dataTime(Stamp now) const;
  static Stamp timeSince(const Arrived& last, Stamp now);
  InputError warningOf(const MissingSource& missing) const;

  FusionInputOptions options_;
  StageRunner& runner_;
  std::optional<MotionInput> motion_;
  std::optional<Arrived> newest_;
  std::optional<Arrived> reference_;                   ///< the newest of the reference
  std::map<std::string, Absence> absences_;            ///< by source
  std::map<std::string, std::uint64_t> times_missed_;  ///< sets without this source
  std::map<std::string, std::uint64_t> left_out_;      ///< by name of the figure
};

}  // namespace datmo
