// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/cloud_conversion.h"

#include <limits>

#include "cloud_samples.h"
#include <gtest/gtest.h>

namespace datmo::cloud_conversion_test {
namespace {

using samples::cloud;
using samples::reasonOf;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

const std::vector<Eigen::Vector3f> kPoints = {
    {1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {7.0F, 8.0F, 9.0F}, {10.0F, 11.0F, 12.0F}};

void expectPoints(const PointsView& view) {
  ASSERT_EQ(view.count, kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    EXPECT_EQ(view[i], kPoints[i]) << i;
  }
}

/// The same points in two rows, with `padding` bytes after each; the last row has none if
/// `cut_last`.
sensor_msgs::PointCloud2 twoRows(std::uint32_t padding, bool cut_last = false) {
  sensor_msgs::PointCloud2 message = cloud(kPoints);
  message.height = 2;
  message.width = 2;
  message.row_step = 2 * message.point_step + padding;
  message.data.insert(message.data.begin() + 2 * message.point_step, padding, 0xFF);
  if (!cut_last) {
    message.data.insert(message.data.end(), padding, 0xFF);
  }
  return message;
}

std::string reasonOfCloud(const std::function<void(sensor_msgs::PointCloud2&)>& spoil) {
  sensor_msgs::PointCloud2 message = cloud(kPoints);
  spoil(message);
  return reasonOf([&message] { CloudPoints{message}; });
}

TEST(CloudConversion, PointsAreReadAtTheirOffsets) {
  const sensor_msgs::PointCloud2 message = cloud(kPoints);
  const CloudPoints points(message);
  EXPECT_EQ(points.view().data, message.data.data());
  expectPoints(points.view());
}

TEST(CloudConversion, FieldsAreFoundByTheirNamesAtAnyOffset) {
  sensor_msgs::PointCloud2 message = cloud(kPoints);
  message.fields = {pointField("intensity", 12), pointField("z", 0), pointField("x", 4),
                    pointField("y", 8)};
  const CloudPoints points(message);
  EXPECT_EQ(points.view()[0], Eigen::Vector3f(2.0F, 3.0F, 1.0F));
}

TEST(CloudConversion, PointsWithoutColorMayBePacked) {
  sensor_msgs::PointCloud2 message = cloud({});
  message.fields.pop_back();
  message.width = 4;
  message.point_step = 12;
  message.row_step = 48;
  message.data.resize(48);
  std::memcpy(message.data.data(), kPoints.data(), 48);
  expectPoints(CloudPoints(message).view());
}

TEST(CloudConversion, OrganizedCloudsAreReadRowByRow) {
  for (const std::uint32_t padding : {0U, 1U, 16U}) {
    for (const bool cut_last : {false, true}) {
      const sensor_msgs::PointCloud2 message = twoRows(padding, cut_last);
      expectPoints(CloudPoints(message).view());
    }
  }
}

TEST(CloudConversion, ACloudOfOneRowNeedsNoRowStep) {
  sensor_msgs::PointCloud2 message = cloud(kPoints);
  message.row_step = 0;
  expectPoints(CloudPoints(message).view());
}

TEST(CloudConversion, OnePointIsEnough) {
  const sensor_msgs::PointCloud2 message = cloud({{kNan, kNan, kNan}, {1.0F, 2.0F, 3.0F}});
  EXPECT_EQ(CloudPoints(message).view().count, 2U) << "holes stay";
}

TEST(CloudConversion, CloudsWithoutAPointAreRefused) {
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.width = 0; }), "empty_cloud");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.height = 0; }), "empty_cloud");
  const auto holes = cloud({{kNan, kNan, kNan}, {1.0F, 1.0F, kInfinity}});
  EXPECT_EQ(reasonOf([&holes] { CloudPoints{holes}; }), "no_valid_point");
}

TEST(CloudConversion, FieldsThatAreNotAsExpectedAreRefused) {
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.fields.clear(); }), "missing_field");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.fields[2].name = "depth"; }),
            "missing_field");
  EXPECT_EQ(reasonOfCloud([](auto& message) {
              message.fields[1].datatype = sensor_msgs::PointField::FLOAT64;
            }),
            "wrong_field_type");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.fields[1].offset = 29; }),
            "wrong_field_type");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.fields[1].offset = 0xFFFFFFFF; }),
            "wrong_field_type");
}

TEST(CloudConversion, DataOfTheWrongSizeIsRefused) {
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.is_bigendian = 1; }), "big_endian");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.data.pop_back(); }), "wrong_size");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.width = 0xFFFFFFFF; }), "wrong_size");
  EXPECT_EQ(reasonOfCloud([](auto& message) {
              message.height = 0xFFFFFFFF;
              message.row_step = 0xFFFFFFFF;
            }),
            "wrong_size");
  EXPECT_EQ(reasonOfCloud([](auto& message) {
              message.height = 2;
              message.width = 2;
              message.row_step = 1;
            }),
            "wrong_size");
  EXPECT_EQ(reasonOfCloud([](auto& message) { message.point_step = 0; }), "wrong_field_type");
}

TEST(CloudConversion, MessagesNameTheError) {
  sensor_msgs::PointCloud2 message = cloud(kPoints);
  message.data.resize(100);
  try {
    CloudPoints{message};
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "cloud of 4 x 1 points with 100 bytes: expected at least 128");
  }
}

TEST(CloudConversion, PointsAreTransformedToAnotherFrame) {
  const sensor_msgs::PointCloud2 message = cloud({{1.0F, 0.0F, 0.0F}, {kNan, 0.0F, 0.0F}});
  CloudPoints points(message);
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.translate(Eigen::Vector3d(0.0, 0.0, 5.0));
  turned.rotate(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()));
  points.transform(turned);
  ASSERT_EQ(points.view().count, 2U);
  EXPECT_TRUE(points.view()[0].isApprox(Eigen::Vector3f(0.0F, 1.0F, 5.0F), 1e-6F));
  EXPECT_FALSE(points.view()[1].allFinite());
}

TEST(StereoCamera, IsReadFromTheRightCamerasInfo) {
  const StereoCamera camera = stereoCamera(samples::rightCameraInfo());
  EXPECT_DOUBLE_EQ(camera.focal_length, 500.0);
  EXPECT_DOUBLE_EQ(camera.baseline, 0.2);
  EXPECT_DOUBLE_EQ(camera.left_tangent, -0.64);
  EXPECT_DOUBLE_EQ(camera.right_tangent, 0.64);
}

TEST(StereoCamera, BinningMakesTheFocalLengthShorterAndTheViewNoNarrower) {
  sensor_msgs::CameraInfo info = samples::rightCameraInfo();
  info.binning_x = 2;
  const StereoCamera camera = stereoCamera(info);
  EXPECT_DOUBLE_EQ(camera.focal_length, 250.0);
  EXPECT_DOUBLE_EQ(camera.baseline, 0.2);
  EXPECT_DOUBLE_EQ(camera.right_tangent, 0.64);
}

TEST(StereoCamera, ARegionOfInterestMakesTheViewNarrower) {
  sensor_msgs::CameraInfo info = samples::rightCameraInfo();
  info.roi.x_offset = 100;
  info.roi.width = 220;
  const StereoCamera camera = stereoCamera(info);
  EXPECT_DOUBLE_EQ(camera.left_tangent, -0.44);
  EXPECT_DOUBLE_EQ(camera.right_tangent, 0.0);
}

TEST(StereoCamera, InvalidInfosAreRefused) {
  const auto reason = [](const std::function<void(sensor_msgs::CameraInfo&)>& spoil) {
    sensor_msgs::CameraInfo info = samples::rightCameraInfo();
    spoil(info);
    return reasonOf([&info] { stereoCamera(info); });
  };
  EXPECT_EQ(reason([](auto& info) { info = sensor_msgs::CameraInfo(); }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.P[3] = 0.0; }), "bad_camera_info") << "the left camera";
  EXPECT_EQ(reason([](auto& info) { info.P[3] = 100.0; }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.P[0] = std::nan(""); }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.P[0] = -500.0; }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.P[2] = kInfinity; }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.width = 0; }), "bad_camera_info");
  EXPECT_EQ(reason([](auto& info) { info.binning_x = 1000; }), "bad_camera_info");
  EXPECT_EQ(reason([](auto&) {}), "");
}

TEST(DepthCamera, NeedsNoBaseline) {
  sensor_msgs::CameraInfo info = samples::rightCameraInfo();
  info.P[3] = 0.0;
  const StereoCamera camera = depthCamera(info);
  EXPECT_DOUBLE_EQ(camera.focal_length, 500.0);
  EXPECT_DOUBLE_EQ(camera.baseline, 0.0);
  EXPECT_DOUBLE_EQ(camera.left_tangent, -0.64);
  info.P[0] = 0.0;
  EXPECT_EQ(reasonOf([&info] { depthCamera(info); }), "bad_camera_info");
}

TEST(CloudPoints, DepthsOutOfRangeAreLeftOut) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const sensor_msgs::PointCloud2 message =
      samples::cloud({{0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 3.0F}, {nan, nan, nan}, {4.0F, 5.0F, 9.0F}});
  CloudPoints points(message);
  points.keepDepths(0.5, 0.0);
  ASSERT_EQ(points.view().count, 2U) << "holes are 0 or NaN";
  points.keepDepths(0.5, 8.0);
  ASSERT_EQ(points.view().count, 1U);
  EXPECT_TRUE(points.view()[0].isApprox(Eigen::Vector3f(1.0F, 2.0F, 3.0F)));
  EXPECT_EQ(reasonOf([&points] { points.keepDepths(4.0, 8.0); }), "no_valid_point");
}

TEST(CloudPoints, ABiasOfDisparitiesIsRemovedAlongLinesOfSight) {
  const sensor_msgs::PointCloud2 message =
      cloud({{2.0F, -1.0F, 10.0F}, {0.0F, 0.0F, 50.0F}, {1.0F, 1.0F, 200.0F}});
  CloudPoints points(message);
  points.shiftInverseDepths(-0.01);
  EXPECT_NEAR(points.view()[0].z(), 1.0 / (0.1 - 0.01), 1e-4);
  EXPECT_NEAR(points.view()[0].x() / points.view()[0].z(), 0.2, 1e-6);
  EXPECT_NEAR(points.view()[0].y() / points.view()[0].z(), -0.1, 1e-6);
  EXPECT_NEAR(points.view()[1].z(), 100.0, 1e-3);
  EXPECT_FALSE(points.view()[2].allFinite()) << "beyond the horizon";
  EXPECT_EQ(points.view().data, message.data.data()) << "without a copy";
  const Eigen::Vector3f corrected = points.view()[0];
  points.keepDepths(11.0, 12.0);
  ASSERT_EQ(points.view().count, 1U);
  EXPECT_EQ(points.view()[0], corrected) << "once, when the points are copied";
}

}  // namespace
}  // namespace datmo::cloud_conversion_test
