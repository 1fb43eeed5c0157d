#include "parameter_tables.h"

#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/ros/grid_slam_stage.h"
#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/tracker_stage.h"

namespace datmo_fusion {

std::string parameterTables() {
  return "### `grid_slam`\n\n" + optionTable<GridSlamStageOptions>() +
         "\n### `moving_objects`\n\n" + optionTable<MovingObjectsStageOptions>() +
         "\n### `tracker`\n\n" + optionTable<TrackerStageOptions>();
}

}  // namespace datmo_fusion
