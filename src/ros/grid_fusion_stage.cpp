#include "datmo_fusion/ros/grid_fusion_stage.h"

#include <algorithm>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/grid_conversion.h"

namespace datmo {

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
  for (const std::string& source : sources()) {
    stamps_.emplace(source, StampCheck(options.input.restart_after));
  }
}

void GridFusionStage::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& message,
                               Stamp now) {
  try {
    SensorGrid grid = gridOf(source, message);
    const Stamp stamp = grid.stamp();
    add(source, std::move(grid));
    if (!newest_ || stamp > newest_->stamp) {
      newest_ = {stamp, now};
    }
    silent_.erase(source);
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

SensorGrid GridFusionStage::gridOf(const std::string& source,
                                   const nav_msgs::OccupancyGrid& message) {
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
  if (stamps->second.check(message.header.stamp) == Arrival::kRestart) {
    motion_.reset();
    restart();
    stamps->second.check(message.header.stamp);
  }
  return grid;
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
  silent_.clear();
}

Stamp GridFusionStage::dataTime(Stamp now) const {
  return newest_->stamp + std::max(0.0, secondsBetween(newest_->came, now));
}

std::optional<GridFusionOutput> GridFusionStage::next(Stamp now) {
  if (!newest_) {
    return std::nullopt;
  }
  const Stopwatch watch;
  const std::optional<MatchedGrids> matched = matcher_.next(dataTime(now));
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
  for (const MissingSource& missing : result.missing) {
    monitor_.figure("fused without " + missing.source,
                    static_cast<double>(++times_missed_[missing.source]));
    if (missing.why == WhyMissing::kSilent && silent_.insert(missing.source).second) {
      monitor_.warned(
          InputError("silent_source", "no grid of " + missing.source + " for " +
                                          std::to_string(options_.matcher.silent_after) +
                                          " s: goes on without it"));
    }
  }
}

}  // namespace datmo
