// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/network_decoding.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace datmo::network_decoding_test {
namespace {

const std::vector<NetworkLabel> kLabels = {NetworkLabel::kPerson, NetworkLabel::kOther,
                                           NetworkLabel::kVehicle};
constexpr int kColumns = 8;
constexpr NetworkSize kInput{64, 32};

NetworkOutput outputOf(const std::vector<float>& values) {
  return {values.data(), static_cast<int>(values.size()) / kColumns, kColumns};
}

NetworkDetection thing(NetworkLabel label, double left, double top, double right, double bottom,
                       double score) {
  return {{Eigen::Vector2d(left, top), Eigen::Vector2d(right, bottom)}, label, score};
}

TEST(NetworkDecoding, YoloOfDarknetByHand) {
  const std::vector<float> values = {0.5F, 0.5F, 0.25F, 0.5F, 0.9F, 0.1F, 0.2F, 0.8F,   // vehicle
                                     0.5F, 0.5F, 0.25F, 0.5F, 0.9F, 0.1F, 0.9F, 0.0F,   // other
                                     0.5F, 0.5F, 0.25F, 0.5F, 0.9F, 0.2F, 0.0F, 0.0F};  // unsure
  const auto things = decodeYolo(outputOf(values), kInput, kLabels, 0.3);
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0].label, NetworkLabel::kVehicle);
  EXPECT_NEAR(things[0].score, 0.8, 1e-6);
  EXPECT_NEAR(things[0].box.min().x(), 24.0, 1e-5);
  EXPECT_NEAR(things[0].box.max().x(), 40.0, 1e-5);
  EXPECT_NEAR(things[0].box.min().y(), 8.0, 1e-5);
  EXPECT_NEAR(things[0].box.max().y(), 24.0, 1e-5);
}

TEST(NetworkDecoding, YoloxByHand) {
  // 8 x 4 cells of 8 px, 4 x 2 of 16, 2 x 1 of 32.
  std::vector<float> values(static_cast<std::size_t>(32 + 8 + 2) * kColumns, 0.0F);
  // Second row, third cell of 16 px: index 32 + 4 + 2.
  float* const row = values.data() + static_cast<std::ptrdiff_t>(38) * kColumns;
  row[0] = 0.5F;
  row[1] = 0.25F;
  row[2] = std::log(2.0F);
  row[3] = 0.0F;
  row[4] = 0.5F;
  row[5] = 0.8F;
  const auto things = decodeYolox(outputOf(values), kInput, kLabels, 0.3);
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0].label, NetworkLabel::kPerson);
  EXPECT_NEAR(things[0].score, 0.4, 1e-6);
  EXPECT_NEAR(things[0].box.center().x(), 40.0, 1e-5);
  EXPECT_NEAR(things[0].box.center().y(), 20.0, 1e-5);
  EXPECT_NEAR(things[0].box.sizes().x(), 32.0, 1e-5);
  EXPECT_NEAR(things[0].box.sizes().y(), 16.0, 1e-5);
}

TEST(NetworkDecoding, OtherOutputsAreRefused) {
  const std::vector<float> values(kColumns, 0.0F);
  EXPECT_THROW(decodeYolox(outputOf(values), kInput, kLabels, 0.3), std::runtime_error);
  EXPECT_THROW(decodeYolo({values.data(), 1, 7}, kInput, kLabels, 0.3), std::runtime_error);
  EXPECT_THROW(decodeYolo({}, kInput, kLabels, 0.3), std::runtime_error);
}

TEST(NetworkDecoding, RowsThatAreNotFiniteAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values = {nan, 0.5F, 0.25F, 0.5F, 0.9F, 0.1F, 0.2F, 0.8F};
  EXPECT_TRUE(decodeYolo(outputOf(values), kInput, kLabels, 0.3).empty());
}

TEST(NetworkDecoding, LabelsByName) {
  EXPECT_EQ(labelOf("person"), NetworkLabel::kPerson);
  EXPECT_EQ(labelOf("motorbike"), NetworkLabel::kCycle);
  EXPECT_EQ(labelOf("bus"), NetworkLabel::kVehicle);
  EXPECT_EQ(labelOf("bench"), NetworkLabel::kOther);
}

TEST(RoadUsers, APersonOnACycleIsACyclist) {
  const auto users = roadUsers({thing(NetworkLabel::kPerson, 100, 100, 130, 180, 0.9),
                                thing(NetworkLabel::kCycle, 90, 150, 140, 200, 0.4),
                                thing(NetworkLabel::kPerson, 300, 100, 330, 200, 0.8)},
                               0.5);
  ASSERT_EQ(users.size(), 2U);
  EXPECT_EQ(users[0].object_class, ObjectClass::kPedestrian);
  EXPECT_EQ(users[1].object_class, ObjectClass::kCyclist);
  EXPECT_NEAR(users[1].score, 0.6, 1e-9);
  EXPECT_NEAR(users[1].box.min().x(), 90.0, 1e-9);
  EXPECT_NEAR(users[1].box.max().y(), 200.0, 1e-9);
}

TEST(RoadUsers, APersonBehindAParkedCycleIsNoRider) {
  const auto users = roadUsers({thing(NetworkLabel::kPerson, 100, 100, 120, 145, 0.9),
                                thing(NetworkLabel::kCycle, 90, 150, 140, 200, 0.9)},
                               0.5);
  ASSERT_EQ(users.size(), 1U) << "and a parked cycle is no road user";
  EXPECT_EQ(users[0].object_class, ObjectClass::kPedestrian);
}

TEST(RoadUsers, AreReportedOnce) {
  const auto users = roadUsers({thing(NetworkLabel::kVehicle, 100, 100, 200, 200, 0.5),
                                thing(NetworkLabel::kVehicle, 102, 100, 202, 200, 0.9)},
                               0.5);
  ASSERT_EQ(users.size(), 1U);
  EXPECT_NEAR(users[0].score, 0.9, 1e-12);
}

TEST(ImageDetector, OverlapIsIntersectionOverUnion) {
  const Eigen::AlignedBox2d a(Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 2));
  const Eigen::AlignedBox2d b(Eigen::Vector2d(1, 0), Eigen::Vector2d(3, 2));
  EXPECT_NEAR(overlap(a, b), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(overlap(a, Eigen::AlignedBox2d()), 0.0, 1e-12);
}

}  // namespace
}  // namespace datmo::network_decoding_test
