// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/fusion_inputs.h"

#include <algorithm>
#include <utility>

#include "datmo_fusion/ros/topic_name.h"

namespace datmo {

void checkSourceNames(const std::vector<std::string>& sources, const std::string& what,
                      const std::set<std::string>& own) {
  std::string names;
  for (const std::string& name : own) {
    names += (names.empty() ? "" : ", ") + name;
  }
  for (const std::string& source : sources) {
    if (!canBeTopic(source) || own.count(source) > 0) {
      throw OptionError("sources/" + source +
                        ": expected a name of letters, digits and underscores that is not one of "
                        "the stage's own " +
                        what + "s (" + names + ")");
    }
  }
}

FusionInputs::FusionInputs(const FusionInputOptions& options, StageRunner& runner)
    : options_(options), runner_(runner) {
  if (options.motion) {
    motion_.emplace(*options.motion, options.frames, runner);
  }
}

void FusionInputs::check(const std::string& source, const std_msgs::Header& header, Stamp now) {
  const std::vector<std::string>& sources = options_.sources;
  if (std::find(sources.begin(), sources.end(), source) == sources.end()) {
    throw InputError("unknown_source",
                     options_.what + " of '" + source + "': expected one of the sources in use");
  }
  if (header.frame_id != options_.frame) {
    throw InputError("wrong_frame", options_.what + " of " + source + " in '" + header.frame_id +
                                        "': expected '" + options_.frame + "'");
  }
  const Arrived arrived{toStamp(header.stamp), now};
  checkAhead(source, arrived.stamp, now);
  runner_.check(source, header.stamp);
  if (!newest_ || arrived.stamp > newest_->stamp) {
    newest_ = arrived;
  }
  if (source == options_.matcher.reference) {
    reference_ = arrived;
  }
}

void FusionInputs::checkAhead(const std::string& source, Stamp stamp, Stamp now) const {
  if (!reference_ || source == options_.matcher.reference ||
      secondsBetween(reference_->arrived, now) > options_.input.silence_after) {
    return;
  }
  const double ahead = secondsBetween(timeSince(*reference_, now), stamp);
  if (ahead > options_.matcher.silent_after) {
    throw InputError("stamp_ahead",
                     options_.what + " of " + source + ", stamp " +
                         std::to_string(stamp.seconds()) + " s, is " + std::to_string(ahead) +
                         " s ahead of those of " + options_.matcher.reference +
                         ", the last one's stamp " + std::to_string(reference_->stamp.seconds()) +
                         " s: expected at most " + std::to_string(options_.matcher.silent_after) +
                         " s; do the sensors' clocks agree?");
  }
}

void FusionInputs::reset() {
  if (motion_) {
    motion_->reset();
  }
  newest_.reset();
  reference_.reset();
  absences_.clear();
}

Stamp FusionInputs::timeSince(const Arrived& last, Stamp now) {
  return last.stamp + std::max(0.0, secondsBetween(last.arrived, now));
}

std::optional<Stamp> FusionInputs::dataTime(Stamp now) const {
  return newest_ ? std::make_optional(timeSince(*newest_, now)) : std::nullopt;
}

void FusionInputs::report(const std::string& source, const LeftOut& left_out) {
  if (left_out.count == 0) {
    return;
  }
  const std::string things = left_out.what + " of " + source;
  runner_.monitor().warned(InputError(left_out.reason, std::to_string(left_out.count) + " " +
                                                           things + ": expected " +
                                                           left_out.expected + "; left out"));
  runner_.monitor().figure(things, static_cast<double>(left_out_[things] += left_out.count));
}

void FusionInputs::report(Stamp stamp, const std::vector<MissingSource>& missing) {
  std::map<std::string, Absence> absences;
  for (const MissingSource& one : missing) {
    const std::string& source = one.source;
    runner_.monitor().figure("fused without " + source,
                             static_cast<double>(++times_missed_[source]));
    const auto before = absences_.find(source);
    Absence& absence = absences[source];
    absence = before == absences_.end() ? Absence{stamp, {}} : before->second;
    // A single set without it means nothing: it may be slower than the reference, or have just
    // started.
    const bool is_silent = one.why == WhyMissing::kSilent;
    const bool lasts =
        is_silent || secondsBetween(absence.since, stamp) >= options_.matcher.silent_after;
    const bool is_fault = !(is_silent && options_.may_be_silent.count(source) > 0);
    if (lasts && is_fault && absence.said.insert(one.why).second) {
      runner_.monitor().warned(warningOf(one));
    }
  }
  absences_ = std::move(absences);
}

InputError FusionInputs::warningOf(const MissingSource& missing) const {
  const SourceMatcherOptions& options = options_.matcher;
  const std::string none = "no " + options_.what + " of " + missing.source + " ";
  const std::string silent_after = std::to_string(options.silent_after) + " s";
  switch (missing.why) {
    case WhyMissing::kNoneNear:
      return {"late_source", none + "in time for " + silent_after + ": expected one within " +
                                 std::to_string(options.tolerance) + " s of the reference's stamp" +
                                 ", arriving within " + std::to_string(options.max_wait) +
                                 " s; continues without it"};
    case WhyMissing::kNoMotion:
      return {"no_motion", none + "used for " + silent_after +
                               ": expected odometry or poses that give the vehicle's motion "
                               "between its stamp and the reference's; continues without it"};
    case WhyMissing::kSilent:
      break;
  }
  return {"silent_source", none + "for " + silent_after + ": continues without it"};
}

}  // namespace datmo
