#include "datmo_fusion/ros/grid_fusion_stage.h"

#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/grid_conversion.h"
#include "datmo_fusion/ros/stage_inputs.h"

namespace datmo {

namespace {

constexpr char kGrid[] = "grid";

}  // namespace

void GridFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  matcher.visit(visitor);
  fuser.visit(visitor);
}

GridFusionStage::GridFusionStage(const GridFusionStageOptions& options, StageMonitor& monitor)
    : options_(options),
      monitor_(monitor),
      inputs_({options.frames.base, options.frames, options.motion, options.input, options.matcher,
               options.fuser.sourcesInUse(), kGrid},
              monitor),
      matcher_(options.matcher, options.fuser.sourcesInUse()),
      fuser_(options.fuser) {
  checkOptions(options);
  checkSourceNames(sources(), kGrid, {"fused", "conflict"});
}

void GridFusionStage::forgetAfter(Arrival arrival) {
  if (arrival == Arrival::kRestart) {
    matcher_.reset();
  }
}

void GridFusionStage::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& message,
                               Stamp now) {
  try {
    SensorGrid grid = fromMessage(message);
    forgetAfter(inputs_.take(source, message.header, now));
    matcher_.add(source, std::move(grid));
  } catch (const WrongWindowError& error) {
    monitor_.dropped(InputError("wrong_window", error.what()));
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

void GridFusionStage::takeOdometry(const nav_msgs::Odometry& message) {
  forgetAfter(inputs_.takeMotion(message));
}

void GridFusionStage::takePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  forgetAfter(inputs_.takeMotion(message));
}

std::optional<GridFusionOutput> GridFusionStage::next(Stamp now) {
  const Stopwatch watch;
  const std::optional<MatchedGrids> matched = inputs_.nextOf(matcher_, now);
  if (!matched) {
    return std::nullopt;
  }
  FusionResult result =
      fuser_.fuse(*matched, [this](Stamp from, Stamp to) { return inputs_.motion(from, to); });
  inputs_.report(matched->stamp(), result.missing);
  const auto toOutput = [this](SensorGrid& grid) {
    return boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(grid), options_.frames.base));
  };
  const GridFusionOutput output{toOutput(result.grids.fused), toOutput(result.grids.conflict)};
  monitor_.processed({matched->stamp(), watch.seconds()});
  return output;
}

void GridFusionStage::connect(StagePorts& ports) {
  fused_ = ports.out<nav_msgs::OccupancyGrid>("grids/fused");
  conflict_ = ports.out<nav_msgs::OccupancyGrid>("grids/conflict");
  connectMotion(ports, options_.motion, *this);
  for (const std::string& source : sources()) {
    ports.in<nav_msgs::OccupancyGrid>(
        "grids/" + source,
        [this, source](const auto& grid, Stamp now) { takeGrid(source, *grid, now); });
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
