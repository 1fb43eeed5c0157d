// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/scene.h"

#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "simulator/collision.h"
#include <gtest/gtest.h>

namespace datmo::simulator::scene_test {
namespace {

const char* const kSmallScene = R"(
options: {duration: 5.0, scanner: {beam_spacing: 1.0}}
roads:
  - {name: main, points: [[0, 0], [100, 0]], width: 12.0}
ego: {path: [[0, -2], [100, -2]], speed: [[0, 8.0]]}
rows:
  - {road: main, side: left, kinds: [car, pole], from: 10, to: 40, spacing: 10, from_curb: -1.1, leave_out: [2]}
fronts:
  - {road: main, side: right, from: 0, to: 40, piece: 15, gap: 5}
actors:
  - {kind: cyclist, path: [[20, 2], [80, 2]], speed: [[0, 4.0]]}
)";

class SceneFile : public testing::Test {
 protected:
  ~SceneFile() override { std::remove(name_.c_str()); }

  const std::string& write(const std::string& text) {
    std::ofstream(name_) << text;
    return name_;
  }

  /// The small scene with one part of it replaced.
  Scene readWith(const std::string& part, const std::string& replacement) {
    std::string text = kSmallScene;
    const std::size_t position = text.find(part);
    EXPECT_NE(position, std::string::npos) << part;
    return readScene(write(text.replace(position, part.size(), replacement)));
  }

  /// Returns the message of the refusal; empty if the scene was accepted.
  std::string refusal(const std::string& part, const std::string& replacement) {
    try {
      readWith(part, replacement);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::string name_ = testing::TempDir() + "simulator_scene_test.yaml";
};

#define EXPECT_IN_ORDER(message, first, second)                        \
  EXPECT_LT((message).find(first), (message).find(second)) << message; \
  EXPECT_NE((message).find(second), std::string::npos) << message

TEST_F(SceneFile, ContactIsReportedIfAllowed) {
  // A car parked in the lane 20 m ahead: from bumper to bumper it is less.
  const std::string standing =
      "actors:\n  - {kind: car, path: [[20, -2], [80, -2]], speed: [[0, 0.0]]}\n";
  const std::string allowed = "duration: 5.0, contact: true,";
  const std::string text = kSmallScene;
  const std::string with_car = text.substr(0, text.find("actors:")) + standing;
  EXPECT_THROW(readScene(write(with_car)), OptionError);

  std::string with_contact = with_car;
  with_contact.replace(with_contact.find("duration: 5.0,"), 14, allowed);
  const Scene scene = readScene(write(with_contact));
  ASSERT_TRUE(scene.contact);
  const Pose2 ego = scene.world.ego().center(0.0);
  const ObjectKind& car = objectKind("car");
  const double gap =
      20.0 + car.axle_to_center - 0.5 * car.length - ego.x() - 0.5 * scene.world.ego().kind.length;
  EXPECT_NEAR(scene.contact->time, gap / 8.0, 2e-3);
  EXPECT_EQ(scene.contact->side, StruckSide::kFront);
  EXPECT_NEAR(scene.contact->speed, 8.0, 1e-6);
  EXPECT_EQ(scene.contact->label, "Car");
  EXPECT_NE(scene.contact->object, kNoObject);
}

TEST_F(SceneFile, HasNoContactIfNothingIsHit) {
  std::string text = kSmallScene;
  text.replace(text.find("duration: 5.0,"), 14, "duration: 5.0, contact: true,");
  EXPECT_FALSE(readScene(write(text)).contact);
}

TEST_F(SceneFile, OthersMayNotMeetBeforeTheContact) {
  std::string text = kSmallScene;
  text.replace(text.find("duration: 5.0,"), 14, "duration: 5.0, contact: true,");
  text += "  - {kind: car, path: [[26, 2], [90, 2]], speed: [[0, 0.0]]}\n";
  EXPECT_THROW(readScene(write(text)), OptionError);
}

TEST_F(SceneFile, BecomesAWorld) {
  const Scene scene = readScene(write(kSmallScene));
  EXPECT_DOUBLE_EQ(scene.options.duration, 5.0);
  EXPECT_EQ(scene.options.scanner.beamCount(), 161);
  const WorldState state = scene.world.at(1.0);
  ASSERT_EQ(state.objects.size(), 4U);
  EXPECT_EQ(state.objects[0].kind.label, "Car");
  EXPECT_NEAR(state.objects[0].center.y(), 4.9, 1e-12);
  EXPECT_NEAR(state.objects[0].center.heading(), kPi, 1e-12);
  EXPECT_EQ(state.objects[1].kind.label, "Pole");
  EXPECT_EQ(state.objects[2].kind.label, "Pole") << "the car in the third place is left out";
  EXPECT_NEAR(state.objects[2].center.x(), 40.0, 1e-12);
  EXPECT_EQ(state.objects[3].kind.label, "Cyclist");
  EXPECT_NEAR(state.objects[3].velocity.x(), 4.0, 1e-12);
  EXPECT_NEAR(state.base.x(), 8.0, 1e-12);
}

TEST_F(SceneFile, OverridesReplaceItsOptions) {
  const Scene scene = readScene(write(kSmallScene), {{"duration", 2}, {"seed", 9}});
  EXPECT_DOUBLE_EQ(scene.options.duration, 2.0);
  EXPECT_EQ(scene.options.seed, 9);
}

TEST_F(SceneFile, RefusalsNameFileLocationValueAndWhatWasExpected) {
  std::string message = refusal("width: 12.0", "width: wide");
  EXPECT_IN_ORDER(message, "simulator_scene_test.yaml: roads[0]: width", "'wide'");
  message = refusal("width: 12.0", "width: 0.5");
  EXPECT_IN_ORDER(message, "roads[0]: width = 0.5", "expected a number from 2");
  message = refusal("width: 12.0", "widht: 12.0");
  EXPECT_IN_ORDER(message, "roads[0]: widht", "nearest one is width");
  message = refusal("duration: 5.0", "duraton: 5.0");
  EXPECT_IN_ORDER(message, "duraton", "nearest one is duration");
  message = refusal("kind: cyclist", "kind: bicycle");
  EXPECT_IN_ORDER(message, "actors[0]: kind = 'bicycle'", "expected one of");
  message = refusal("[car, pole]", "[car, post]");
  EXPECT_IN_ORDER(message, "rows[0]: kind = 'post'", "expected one of");
  message = refusal("{road: main, side: right", "{road: high, side: right");
  EXPECT_IN_ORDER(message, "fronts[0]: road = 'high'", "'main'");
  message = refusal("actors:", "actor:");
  EXPECT_IN_ORDER(message, "actor: expected one of the sections", "actors");
}

TEST_F(SceneFile, BadListsAreRefused) {
  std::string message = refusal("[[20, 2], [80, 2]]", "[[20, 2], [80]]");
  EXPECT_IN_ORDER(message, "actors[0]: path[1] has 1 numbers", "lists of 2 numbers");
  message = refusal("[[0, 4.0]]", "fast");
  EXPECT_IN_ORDER(message, "actors[0]: speed", "lists of 2 numbers");
  message = refusal("[[0, 4.0]]", "[[0, -4.0]]");
  EXPECT_IN_ORDER(message, "actors[0]: speed point 0", "at least 0 m/s");
  message = refusal("leave_out: [2]", "leave_out: second");
  EXPECT_IN_ORDER(message, "rows[0]: leave_out", "whole numbers");
}

TEST_F(SceneFile, PathThatIsTooShortForItsSpeedIsRefused) {
  const std::string message = refusal("[[20, 2], [80, 2]]", "[[20, 2], [30, 2]]");
  EXPECT_IN_ORDER(message, "actors[0]: path of 10 m", "at least the 20 m");
}

TEST_F(SceneFile, BodiesThatCollideAreRefused) {
  const std::string message = refusal("[[20, 2], [80, 2]]", "[[50, -2], [20, -2]]");
  EXPECT_IN_ORDER(message, "ego vehicle and Cyclist collide at",
                  "expected paths without collisions");
  EXPECT_NE(refusal("from_curb: -1.1", "from_curb: -4.0"), "");
}

TEST_F(SceneFile, MissingOrBrokenFileIsNamed) {
  try {
    readScene("/no/such/scene.yaml");
    FAIL();
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/scene.yaml"), std::string::npos);
  }
  EXPECT_IN_ORDER(refusal("width: 12.0}", "width: 12.0"),
                  "simulator_scene_test.yaml:", "expected yaml");
  EXPECT_IN_ORDER(refusal("ego:", "# ego:"), "simulator_scene_test.yaml", "ego is missing");
}

/// Returns the shipped scene.
const std::string kIntersection = std::string(DATMO_FUSION_SCENES) + "/intersection.yaml";

TEST(Intersection, NothingIsEverAtTheSamePosition) {
  const Scene scene = readScene(kIntersection);
  EXPECT_FALSE(firstCollision(scene.world, scene.options.duration));
}

TEST(Intersection, HasWhatTheDemoNeeds) {
  const Scene scene = readScene(kIntersection);
  LaserScanner scanner(scene.options.scanner, RandomStream(1, "scanner"));
  std::map<std::uint32_t, int> visible_scans;
  std::map<std::uint32_t, std::string> labels;
  bool at_intersection = false;
  constexpr double kSecondsPerScan = 0.1;
  for (double time = 0.0; time < scene.options.duration; time += kSecondsPerScan) {
    const WorldState state = scene.world.at(time);
    at_intersection |= scene.world.roads().atIntersection(state.base.position());
    for (const ObjectTruth& truth :
         objectTruths(scene.world, state, scanner.measure(scene.world, time), {scanner.viewpoint()},
                      scene.options.ground_truth)) {
      if (truth.state.moving && !truth.visible_to.empty()) {
        ++visible_scans[truth.state.id];
        labels[truth.state.id] = truth.state.kind.label;
      }
    }
  }
  EXPECT_TRUE(at_intersection);
  std::multiset<std::string> seen;
  for (const auto& [id, scans] : visible_scans) {
    if (scans * kSecondsPerScan > 1.0) {
      seen.insert(labels[id]);
    }
  }
  EXPECT_EQ(seen, (std::multiset<std::string>{"Car", "Car", "Cyclist", "Cyclist", "Pedestrian",
                                              "Pedestrian", "Pedestrian", "Truck", "Van"}));
}

}  // namespace
}  // namespace datmo::simulator::scene_test
