#include "low_level_pipeline.h"

#include <algorithm>

namespace datmo {

LowLevelPipeline::LowLevelPipeline(const LowLevelOptions& options,
                                   const TransformBuffer& transforms, StageTimes& times)
    : times_(times),
      longest_wait_(options.grid_fusion.matcher.longest_wait),
      lidar_(options.lidar_grid, transforms, lidar_monitor_),
      stereo_(options.stereo_grid, transforms, stereo_monitor_),
      fusion_(options.grid_fusion, fusion_monitor_),
      sources_(fusion_.sources()) {}

void LowLevelPipeline::takeCloud(const sensor_msgs::PointCloud2& message, Stamp now,
                                 std::vector<NamedGrid>& grids) {
  offer("stereo", stereo_.takeCloud(message), stereo_monitor_, now, grids);
}

void LowLevelPipeline::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& grid,
                                Stamp now) {
  fusion_.takeGrid(source, grid, now);
}

void LowLevelPipeline::takeOdometry(const nav_msgs::Odometry& message) {
  lidar_.takeOdometry(message);
  fusion_.takeOdometry(message);
}

void LowLevelPipeline::takePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  lidar_.takePose(message);
  fusion_.takePose(message);
}

nav_msgs::OccupancyGridPtr LowLevelPipeline::nextFused(Stamp now, std::vector<NamedGrid>& grids) {
  const std::optional<GridFusionOutput> output = fusion_.next(now);
  if (!output) {
    return nullptr;
  }
  bookTime(fusion_monitor_);
  grids.emplace_back("fused", output->fused);
  grids.emplace_back("conflict", output->conflict);
  return output->fused;
}

void LowLevelPipeline::offer(const std::string& source, const nav_msgs::OccupancyGridPtr& grid,
                             const StageMonitor& monitor, Stamp now,
                             std::vector<NamedGrid>& grids) {
  if (!grid) {
    return;
  }
  bookTime(monitor);
  grids.emplace_back(source, grid);
  if (std::find(sources_.begin(), sources_.end(), source) != sources_.end()) {
    fusion_.takeGrid(source, *grid, now);
  }
}

void LowLevelPipeline::bookTime(const StageMonitor& monitor) {
  times_.add(monitor.stage(), monitor.lastProcessed().seconds);
}

}  // namespace datmo
