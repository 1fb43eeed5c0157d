#include "datmo_fusion/ros/grid_fusion_stage.h"

#include <algorithm>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/grid_conversion.h"
#include "datmo_fusion/ros/topic_name.h"

namespace datmo {

namespace {

/// Throws OptionError for a source whose topic could not be, or would be one that is made here.
void checkSources(const std::vector<std::string>& sources) {
  for (const std::string& source : sources) {
    if (!canBeTopic(source) || source == "fused" || source == "conflict") {
      throw OptionError("sources/" + source +
                        ": expected a name of letters, digits and underscores that is not one of "
                        "the grids of grid_fusion itself, fused and conflict");
    }
  }
}

}  // namespace

void GridFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"base_frame", "", "frame of the vehicle, and of all grids"}, base_frame, {});
  motion.visit(visitor);
  visitor.group("input", [&] { input.visit(visitor); });
  matcher.visit(visitor);
  fuser.visit(visitor);
}

GridFusionStage::GridFusionStage(const GridFusionStageOptions& options, StageMonitor& monitor)
    : options_(options),
      monitor_(monitor),
      matcher_(options.matcher, options.fuser.sourcesInUse()),
      fuser_(options.fuser),
      motion_(options.motion, options.base_frame, options.input.restart_after) {
  checkOptions(options);
  checkSources(sources());
  for (const std::string& source : sources()) {
    stamps_.emplace(source, StampCheck(options.input.restart_after));
  }
}

void GridFusionStage::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& message,
                               Stamp now) {
  try {
    SensorGrid grid = gridOf(source, message, now);
    const Arrived arrived{grid.stamp(), now};
    add(source, std::move(grid));
    if (!newest_ || arrived.stamp > newest_->stamp) {
      newest_ = arrived;
    }
    if (source == options_.matcher.reference) {
      reference_ = arrived;
    }
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

SensorGrid GridFusionStage::gridOf(const std::string& source,
                                   const nav_msgs::OccupancyGrid& message, Stamp now) {
  const auto stamps = stamps_.find(source);
  if (stamps == stamps_.end()) {
    throw InputError("unknown_source",
                     "grid of '" + source + "': expected one of the sources that are in use");
  }
  if (message.header.frame_id != options_.base_frame) {
    throw InputError("wrong_frame", "grid of " + source + " in '" + message.header.frame_id +
                                        "': expected '" + options_.base_frame + "'");
  }
  SensorGrid grid = fromMessage(message);
  checkAhead(source, grid.stamp(), now);
  if (stamps->second.check(message.header.stamp) == Arrival::kRestart) {
    motion_.reset();
    restart();
    stamps->second.check(message.header.stamp);
  }
  return grid;
}

void GridFusionStage::checkAhead(const std::string& source, Stamp stamp, Stamp now) const {
  if (!reference_ || source == options_.matcher.reference ||
      secondsBetween(reference_->came, now) > options_.input.silence_after) {
    return;
  }
  const double ahead = secondsBetween(dataTime(*reference_, now), stamp);
  if (ahead > options_.matcher.silent_after) {
    throw InputError("stamp_ahead",
                     "grid of " + source + ", stamp " + std::to_string(stamp.seconds()) +
                         " s, is " + std::to_string(ahead) + " s ahead of those of " +
                         options_.matcher.reference + ", the last one's stamp " +
                         std::to_string(reference_->stamp.seconds()) + " s: expected at most " +
                         std::to_string(options_.matcher.silent_after) +
                         " s; do the sensors' clocks agree?");
  }
}

void GridFusionStage::add(const std::string& source, SensorGrid grid) {
  try {
    matcher_.add(source, std::move(grid));
  } catch (const WrongWindowError& error) {
    throw InputError("wrong_window", error.what());
  }
}

void GridFusionStage::takeOdometry(const nav_msgs::Odometry& message) { takeMotion(message); }

void GridFusionStage::takePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  takeMotion(message);
}

template <typename Message>
void GridFusionStage::takeMotion(const Message& message) {
  try {
    if (motion_.take(message) == Arrival::kRestart) {
      restart();
    }
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

void GridFusionStage::restart() {
  monitor_.warned(InputError("clock_restart", "the clock jumped back: forgets all grids"));
  matcher_.reset();
  for (auto& [source, stamps] : stamps_) {
    stamps = StampCheck(options_.input.restart_after);
  }
  newest_.reset();
  reference_.reset();
  absences_.clear();
}

Stamp GridFusionStage::dataTime(const Arrived& last, Stamp now) {
  return last.stamp + std::max(0.0, secondsBetween(last.came, now));
}

std::optional<GridFusionOutput> GridFusionStage::next(Stamp now) {
  if (!newest_) {
    return std::nullopt;
  }
  const Stopwatch watch;
  const std::optional<MatchedGrids> matched = matcher_.next(dataTime(*newest_, now));
  if (!matched) {
    return std::nullopt;
  }
  FusionResult result =
      fuser_.fuse(*matched, [this](Stamp from, Stamp to) { return motion_.between(from, to); });
  report(result);
  const auto toOutput = [this](SensorGrid& grid) {
    return boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(grid), options_.base_frame));
  };
  const GridFusionOutput output{toOutput(result.grids.fused), toOutput(result.grids.conflict)};
  monitor_.processed({matched->stamp(), watch.seconds()});
  return output;
}

void GridFusionStage::report(const FusionResult& result) {
  const Stamp stamp = result.grids.fused.stamp();
  std::map<std::string, Absence> absences;
  for (const MissingSource& missing : result.missing) {
    const std::string& source = missing.source;
    monitor_.figure("fused without " + source, static_cast<double>(++times_missed_[source]));
    const auto before = absences_.find(source);
    Absence& absence = absences[source];
    absence = before == absences_.end() ? Absence{stamp, {}} : before->second;
    // One set without it is nothing: it may be slower than the reference, or have just begun.
    const bool lasts = missing.why == WhyMissing::kSilent ||
                       secondsBetween(absence.since, stamp) >= options_.matcher.silent_after;
    if (lasts && absence.said.insert(missing.why).second) {
      monitor_.warned(warningOf(missing));
    }
  }
  absences_ = std::move(absences);
}

InputError GridFusionStage::warningOf(const MissingSource& missing) const {
  const GridMatcherOptions& options = options_.matcher;
  const std::string grid_of = "no grid of " + missing.source + " ";
  const std::string silent_after = std::to_string(options.silent_after) + " s";
  switch (missing.why) {
    case WhyMissing::kNoneNear:
      return {"late_source", grid_of + "in time for " + silent_after + ": expected one within " +
                                 std::to_string(options.tolerance) + " s of the reference's stamp" +
                                 " and after " + std::to_string(options.longest_wait) +
                                 " s at most; goes on without it"};
    case WhyMissing::kNoMotion:
      return {"no_motion", grid_of + "used for " + silent_after +
                               ": expected to know from odometry or poses how the vehicle moved "
                               "between its stamp and the reference's; goes on without it"};
    case WhyMissing::kSilent:
      break;
  }
  return {"silent_source", grid_of + "for " + silent_after + ": goes on without it"};
}

}  // namespace datmo
