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

/// Requirements of a stage that fuses several sources.
struct FusionInputOptions {
  std::string frame;  ///< of all messages
  FrameOptions frames;
  std::optional<MotionOptions> motion;  ///< none: `frame` is fixed
  StreamOptions input;
  SourceMatcherOptions matcher;
  std::vector<std::string> sources;
  std::string what;                       ///< name of one message of a source: "grid"
  std::set<std::string> may_be_silent{};  ///< sources whose silence is not reported
};

/// Parts of a message that are ignored, while the rest of it is used.
struct LeftOut {
  std::string reason;  ///< as in InputError
  std::size_t count = 0;
  std::string what;      ///< "bad views"
  std::string expected;  ///< from such a source
};

/// Throws OptionError for a source whose topic is invalid or conflicts with one of the stage's own.
/// `what`: name of one message of a source; `own`: the stage's output topics.
void checkSourceNames(const std::vector<std::string>& sources, const std::string& what,
                      const std::set<std::string>& own);

/// Input check of a stage that fuses several sources: accepts or rejects messages, keeps the data
/// time and the vehicle's motion, and reports missing sources.
///
/// A source that falls silent is reported once until it is fused again, unless it may be silent; so
/// is one that is too late, or whose motion is unknown, for as long.
///
/// The reference's stamps are authoritative: while it publishes, a message of another source that
/// is ahead of them by more than `silent_after` is rejected (`stamp_ahead`), because a clock that
/// is ahead would make the reference look silent.
///
/// Time is data time: the stamp of the newest message, plus the time elapsed since its arrival on
/// the caller's clock. So the two clocks need not agree.
class FusionInputs {
 public:
  /// `runner`: of the stage, which must call reset() when it is reset itself; it must outlive the
  /// inputs. Throws OptionError.
  FusionInputs(const FusionInputOptions& options, StageRunner& runner);

  /// Checks a message of a source. `now`: ROS time. Throws InputError: `unknown_source`,
  /// `wrong_frame`, `stamp_ahead` and those of StageRunner::check.
  void check(const std::string& source, const std_msgs::Header& header, Stamp now);

  /// Sets the newest motion, like MotionInput; a bad one is dropped and reported to the monitor.
  /// Requires that the options have motion (else std::bad_optional_access). `Message`:
  /// nav_msgs::Odometry or geometry_msgs::PoseWithCovarianceStamped.
  template <typename Message>
  void handleMotion(const Message& message) {
    runner_.serve([&] { motion_.value().update(message); });
  }

  /// Forgets everything.
  void reset();

  /// Warns about unusable parts of this source's message, if any, and counts them.
  void report(const std::string& source, const LeftOut& left_out);

  /// Returns the next set of the stage's matcher; none if nothing is ready. `now`: ROS time.
  template <typename Matcher>
  auto nextOf(Matcher& matcher, Stamp now) const -> decltype(matcher.next(now)) {
    const std::optional<Stamp> time = dataTime(now);
    return time ? matcher.next(*time) : std::nullopt;
  }

  /// Returns the first set of the stage's matcher that waits for others and is newer than `newest`,
  /// with what has been received so far; none if there is none. `now`: ROS time.
  template <typename Payload>
  std::optional<MatchedSamples<Payload>> earlyOf(const SourceMatcher<Payload>& matcher,
                                                 const std::optional<Stamp>& newest,
                                                 Stamp now) const {
    const std::optional<Stamp> time = dataTime(now);
    return time ? matcher.early(newest, *time) : std::nullopt;
  }

  /// Returns the vehicle's motion from one stamp to a later one; none if unknown. Requires that the
  /// options have motion (else std::bad_optional_access).
  std::optional<Pose2> motion(Stamp from, Stamp to) const {
    return motion_.value().between(from, to);
  }

  /// Warns that the set at this stamp was fused without these sources, and counts it.
  void report(Stamp stamp, const std::vector<MissingSource>& missing);

  /// Reports as figures how many lists of each source were in no set.
  template <typename Payload>
  void reportUnserved(const SourceMatcher<Payload>& matcher) {
    for (const std::string& source : options_.sources) {
      runner_.monitor().figure("lists of " + source + " not fused",
                               static_cast<double>(matcher.unserved(source)));
    }
  }

 private:
  /// A message's arrival; `arrived`: time on the caller's clock.
  struct Arrived {
    Stamp stamp;
    Stamp arrived;
  };

  /// Absence of a source from the last set.
  struct Absence {
    Stamp since;                ///< stamp of the first set without it
    std::set<WhyMissing> said;  ///< reasons already warned about
  };

  void checkAhead(const std::string& source, Stamp stamp, Stamp now) const;

  /// Data time at this ROS time; none before the first message.
  std::optional<Stamp> dataTime(Stamp now) const;
  static Stamp timeSince(const Arrived& last, Stamp now);
  InputError warningOf(const MissingSource& missing) const;

  FusionInputOptions options_;
  StageRunner& runner_;
  std::optional<MotionInput> motion_;
  std::optional<Arrived> newest_;
  std::optional<Arrived> reference_;                   ///< newest message of the reference
  std::map<std::string, Absence> absences_;            ///< by source
  std::map<std::string, std::uint64_t> times_missed_;  ///< sets without this source
  std::map<std::string, std::uint64_t> left_out_;      ///< by name of the figure
};

}  // namespace datmo
