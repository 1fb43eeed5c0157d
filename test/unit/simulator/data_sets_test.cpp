// SPDX-License-Identifier: BSD-3-Clause
// The scenes that stand in for the data sets of thesis tables 3.1 and 3.5 contain what those list.
#include <cmath>
#include <set>
#include <string>

#include "simulator/ground_truth.h"
#include "simulator/scene.h"
#include <gtest/gtest.h>

namespace datmo::simulator::data_sets_test {
namespace {

struct DataSet {
  int number = 0;
  double duration = 0.0;  ///< s
  std::size_t moving_objects = 0;
  int intersections = 0;
  bool light = false;  ///< the vehicle waits at one
};

/// What the scanner and the vehicle encounter.
struct Seen {
  std::set<std::uint32_t> moving;  ///< ids of objects in the scanner's sight while they move
  std::set<std::string> labels;    ///< of these
  int intersections = 0;           ///< episodes
  double standing = 0.0;           ///< s, of the vehicle
};

Seen lookRound(const Scene& scene) {
  const double period = 1.0 / scene.options.scanner.scan_rate;
  const double share = scene.options.ground_truth.min_visible_share;
  const Viewpoint view =
      LaserScanner(scene.options.scanner, RandomStream(1, "scanner")).viewpoint();
  Seen seen;
  bool was_at_intersection = false;
  for (int scan = 0; scan * period < scene.options.duration; ++scan) {
    const WorldState state = scene.world.at(scan * period);
    for (const ObjectState& object : state.objects) {
      const double distance = (object.center.position() - state.base.position()).norm();
      if (object.moving && distance <= scene.options.ground_truth.radius &&
          lookAt(object, view, scene.world, state).visible >= share) {
        seen.moving.insert(object.id);
        seen.labels.insert(object.kind.label);
      }
    }
    const bool at_intersection = scene.world.roads().atIntersection(state.base.position());
    seen.intersections += at_intersection && !was_at_intersection ? 1 : 0;
    was_at_intersection = at_intersection;
    seen.standing += state.twist.forward_speed == 0.0 ? period : 0.0;
  }
  return seen;
}

class DataSetScene : public testing::TestWithParam<DataSet> {};

TEST_P(DataSetScene, HoldsTheThesissContents) {
  const DataSet& expected = GetParam();
  const Scene scene =
      readScene(DATMO_FUSION_SCENES "/data_set_" + std::to_string(expected.number) + ".yaml");
  EXPECT_DOUBLE_EQ(scene.options.duration, expected.duration);
  const Seen seen = lookRound(scene);
  EXPECT_EQ(seen.moving.size(), expected.moving_objects);
  EXPECT_EQ(scene.world.movers().size(), expected.moving_objects) << "one is never seen moving";
  EXPECT_EQ(seen.intersections, expected.intersections);
  EXPECT_EQ(seen.labels, (std::set<std::string>{"Car", "Van", "Truck", "Cyclist", "Pedestrian"}));
  EXPECT_EQ(seen.standing > 10.0, expected.light);
}

TEST_P(DataSetScene, IsMeasuredByTheDemonstratorsScannerWithItsFaults) {
  const Scene scene =
      readScene(DATMO_FUSION_SCENES "/data_set_" + std::to_string(GetParam().number) + ".yaml");
  const LaserScannerOptions demonstrator;
  EXPECT_EQ(scene.options.scanner.scan_rate, demonstrator.scan_rate);
  EXPECT_EQ(scene.options.scanner.beamCount(), demonstrator.beamCount());
  EXPECT_EQ(scene.options.scanner.range_noise, demonstrator.range_noise);
  EXPECT_EQ(scene.options.scanner.paint_hit_probability, demonstrator.paint_hit_probability);
  EXPECT_EQ(scene.options.scanner.pitch_shake, demonstrator.pitch_shake);
}

INSTANTIATE_TEST_SUITE_P(Thesis, DataSetScene,
                         testing::Values(DataSet{1, 64.0, 30, 2, false},
                                         DataSet{2, 150.0, 21, 1, true},
                                         DataSet{3, 196.0, 43, 4, true}),
                         [](const auto& data_set) {
                           return "DataSet" + std::to_string(data_set.param.number);
                         });

}  // namespace
}  // namespace datmo::simulator::data_sets_test
