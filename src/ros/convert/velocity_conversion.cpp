// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/velocity_conversion.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "message_parts.h"
#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/point_field.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

using sensor_msgs::PointField;

constexpr std::array<const char*, 12> kFields = {
    "x", "y", "z", "vx", "vy", "vz", "xx", "xy", "yy", "common_xx", "common_xy", "common_yy"};
using Values = std::array<float, kFields.size()>;

Values valuesOf(const PointVelocity& point) {
  const auto& p = point.position;
  const auto& v = point.velocity;
  const auto& own = point.covariance;
  const auto& common = point.common_covariance;
  const std::array<double, kFields.size()> values = {
      p.x(),     p.y(),     p.z(),     v.x(),        v.y(),        v.z(),
      own(0, 0), own(0, 1), own(1, 1), common(0, 0), common(0, 1), common(1, 1)};
  Values result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    result[i] = static_cast<float>(values[i]);
  }
  return result;
}

Eigen::Matrix3d covarianceOf(double xx, double xy, double yy) {
  Eigen::Matrix3d covariance = (xx + yy) * Eigen::Matrix3d::Identity();
  covariance.topLeftCorner<2, 2>() << xx, xy, xy, yy;
  return covariance;
}

PointVelocity pointOf(const Values& values) {
  PointVelocity point;
  point.position = {values[0], values[1], values[2]};
  point.velocity = {values[3], values[4], values[5]};
  point.covariance = covarianceOf(values[6], values[7], values[8]);
  point.common_covariance = covarianceOf(values[9], values[10], values[11]);
  return point;
}

/// False for NaN.
bool isUsable(const PointVelocity& point) {
  const auto spread = [](const Eigen::Matrix3d& covariance) {
    return covariance.topLeftCorner<2, 2>().determinant();
  };
  return point.position.allFinite() && point.velocity.allFinite() && point.covariance.allFinite() &&
         point.common_covariance.allFinite() && point.covariance(0, 0) > 0.0 &&
         spread(point.covariance) > 0.0 && point.common_covariance(0, 0) >= 0.0 &&
         spread(point.common_covariance) >= 0.0;
}

/// Throws InputError unless the fields have the layout of toMessage.
void check(const sensor_msgs::PointCloud2& message) {
  if (message.is_bigendian != 0U) {
    throw InputError("big_endian", "cloud of big endian numbers: expected little endian ones");
  }
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    const std::string expected = std::string("expected x y z vx vy vz xx xy yy common_xx ") +
                                 "common_xy common_yy, FLOAT32 side by side";
    if (i >= message.fields.size() || message.fields[i].name != kFields[i]) {
      throw InputError("missing_field", std::string("point velocities without field ") +
                                            kFields[i] + ": " + expected);
    }
    if (message.fields[i].datatype != PointField::FLOAT32 ||
        message.fields[i].offset != i * sizeof(float)) {
      throw InputError("wrong_field_type", std::string("point velocities with field ") +
                                               kFields[i] + " at another offset: " + expected);
    }
  }
  const std::uint64_t bytes = std::uint64_t{message.width} * message.height * message.point_step;
  if (message.point_step < sizeof(Values) || message.data.size() != bytes) {
    throw InputError("wrong_size", "point velocities with " + std::to_string(message.data.size()) +
                                       " bytes: expected " + std::to_string(bytes) + ", at least " +
                                       std::to_string(sizeof(Values)) + " a point");
  }
}

}  // namespace

sensor_msgs::PointCloud2Ptr toMessage(const std::vector<PointVelocity>& points, Stamp stamp,
                                      const std::string& frame) {
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = header(stamp, frame);
  message->height = 1;
  message->width = static_cast<std::uint32_t>(points.size());
  message->fields = floatFields({kFields.begin(), kFields.end()});
  message->point_step = sizeof(Values);
  message->row_step = message->point_step * message->width;
  message->is_dense = 1U;
  message->data.resize(message->row_step);
  std::uint8_t* next = message->data.data();
  for (const PointVelocity& point : points) {
    const Values values = valuesOf(point);
    std::memcpy(next, values.data(), sizeof(Values));
    next += sizeof(Values);
  }
  return message;
}

std::vector<PointVelocity> pointVelocities(const sensor_msgs::PointCloud2& message) {
  check(message);
  std::vector<PointVelocity> points;
  for (std::size_t begin = 0; begin < message.data.size(); begin += message.point_step) {
    Values values;
    std::memcpy(values.data(), &message.data[begin], sizeof(Values));
    const PointVelocity point = pointOf(values);
    if (isUsable(point)) {
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace datmo
