// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"

#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

namespace {

constexpr char kGrid[] = "grid";

}  // namespace

void GridFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  matcher.visit(visitor);
  fuser.visit(visitor);
}

GridFusionStage::GridFusionStage(const Checked<GridFusionStageOptions>& options,
                                 StageMonitor& monitor)
    : options_(*options),
      runner_(monitor, options->input, std::string("forgets all ") + kGrid + "s",
              [this] { reset(); }),
      inputs_({options->frames.base, options->frames, options->motion, options->input,
               options->matcher, options->fuser.sourcesInUse(), kGrid},
              runner_),
      matcher_(options->matcher, options->fuser.sourcesInUse()),
      fuser_(options->fuser) {
  checkSourceNames(sources(), kGrid, {"fused", "conflict"});
}

void GridFusionStage::reset() {
  inputs_.reset();
  matcher_.reset();
}

void GridFusionStage::handleGrid(const std::string& source, const nav_msgs::OccupancyGrid& message,
                                 Stamp now) {
  runner_.serve([&] {
    SensorGrid grid = fromMessage(message);
    inputs_.check(source, message.header, now);
    try {
      matcher_.add(source, std::move(grid));
    } catch (const WrongWindowError& error) {
      throw InputError("wrong_window", error.what());
    }
  });
}

std::optional<GridFusionOutput> GridFusionStage::next(Stamp now) {
  return runner_.serve([&]() -> std::optional<GridFusionOutput> {
    const std::optional<MatchedGrids> matched = inputs_.nextOf(matcher_, now);
    return matched ? std::make_optional(fuse(*matched)) : std::nullopt;
  });
}

GridFusionOutput GridFusionStage::fuse(const MatchedGrids& matched) {
  FusionResult result =
      fuser_.fuse(matched, [this](Stamp from, Stamp to) { return inputs_.motion(from, to); });
  inputs_.report(matched.stamp(), result.missing);
  const auto toOutput = [this](SensorGrid& grid) {
    return boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(grid), options_.frames.base));
  };
  const GridFusionOutput output{toOutput(result.grids.fused), toOutput(result.grids.conflict)};
  runner_.processed(matched.stamp());
  return output;
}

void GridFusionStage::change(const OptionValues& values) {
  const auto changed = withLiveValues(options_, values);
  fuser_ = GridFuser(changed.fuser);
  options_ = changed;
}

void GridFusionStage::connect(StagePorts& ports) {
  fused_ = ports.out<nav_msgs::OccupancyGrid>("grids/fused");
  conflict_ = ports.out<nav_msgs::OccupancyGrid>("grids/conflict");
  connectMotion(ports, options_.motion, *this);
  for (const std::string& source : sources()) {
    ports.in<nav_msgs::OccupancyGrid>(
        "grids/" + source,
        [this, source](const auto& grid, Stamp now) { handleGrid(source, *grid, now); });
  }
}

bool GridFusionStage::publishNext(Stamp now) {
  const auto output = next(now);
  if (output) {
    fused_.publish(output->fused);
    conflict_.publish(output->conflict);
  }
  return output.has_value();
}

}  // namespace datmo
