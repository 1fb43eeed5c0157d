// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "datmo_fusion/ros/convert/cloud_conversion.h"

namespace datmo {

namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::array<const char*, 4> kTimeFields = {"t", "offset_time", "time", "timestamp"};

constexpr double kNanosecond = 1e-9;  // s

/// Times above this (s) are counted since 1970 rather than from the stamp.
constexpr double kEpoch = 1e6;

template <typename Number>
double numberAt(const std::uint8_t* data) {
  Number number;
  std::memcpy(&number, data, sizeof(number));
  return static_cast<double>(number);
}

/// The times of a cloud's points, read from one of its fields.
class PointTimes {
 public:
  explicit PointTimes(const PointCloud2& message) : stamp_(message.header.stamp.toSec()) {
    for (const char* name : kTimeFields) {
      const auto field = std::find_if(message.fields.begin(), message.fields.end(),
                                      [name](const PointField& f) { return f.name == name; });
      if (field != message.fields.end() && sizeOf(*field) > 0 &&
          std::uint64_t{field->offset} + sizeOf(*field) <= message.point_step) {
        field_ = &*field;
        return;
      }
    }
  }

  std::string field() const { return field_ != nullptr ? field_->name : ""; }

  /// Returns s after the cloud's stamp. `point`: start of its bytes.
  double at(const std::uint8_t* point) const {
    const std::uint8_t* data = point + field_->offset;
    switch (field_->datatype) {
      case PointField::UINT32:
        return kNanosecond * numberAt<std::uint32_t>(data);
      case PointField::FLOAT32:
        return numberAt<float>(data);
      default:
        const double time = numberAt<double>(data);
        return time > kEpoch ? time - stamp_ : time;
    }
  }

 private:
  /// 0: not a valid type for times.
  static std::size_t sizeOf(const PointField& field) {
    switch (field.datatype) {
      case PointField::UINT32:
      case PointField::FLOAT32:
        return sizeof(float);
      case PointField::FLOAT64:
        return sizeof(double);
      default:
        return 0;
    }
  }

  double stamp_;
  const PointField* field_ = nullptr;
};

/// The fault of the first time that is not close to the stamp; NaN never is.
std::optional<InputError> faultOf(const std::vector<float>& times, const std::string& field,
                                  double max_sweep) {
  const auto bad = std::find_if(times.begin(), times.end(),
                                [max_sweep](float time) { return !(std::abs(time) <= max_sweep); });
  if (bad == times.end()) {
    return std::nullopt;
  }
  return InputError("bad_point_times", "cloud with a point " + std::to_string(*bad) +
                                           " s after its stamp (field " + field +
                                           "): expected at most " + std::to_string(max_sweep) +
                                           " s; continues without the points' times");
}

}  // namespace

ConvertedCloud toLidarCloud(const PointCloud2& message, double max_sweep) {
  const CloudPoints points(message);
  const PointsView& view = points.view();
  const PointTimes times(message);
  ConvertedCloud converted;
  converted.time_field = times.field();
  LidarCloud& cloud = converted.cloud;
  const bool has_times = !converted.time_field.empty();
  cloud.points->resize(view.count);
  cloud.times.resize(has_times ? view.count : 0);
  std::size_t finite = 0;
  for (std::size_t i = 0; i < view.count; ++i) {
    const Eigen::Vector3f point = view[i];
    if (!point.allFinite()) {
      continue;
    }
    (*cloud.points)[finite].getVector3fMap() = point;
    if (has_times) {
      cloud.times[finite] = static_cast<float>(times.at(view.data + i * view.step));
    }
    ++finite;
  }
  cloud.points->resize(finite);
  cloud.times.resize(has_times ? finite : 0);
  converted.holes = view.count - cloud.points->size();
  converted.unusable_times = faultOf(cloud.times, converted.time_field, max_sweep);
  if (converted.unusable_times) {
    cloud.times.clear();
  }
  return converted;
}

void visitMaxSweep(OptionVisitor& visitor, double& max_sweep) {
  visitor.number({"max_sweep", "s",
                  "maximum time between a point and its cloud's stamp; beyond it the cloud's point "
                  "times are not used (slow lidars turn 5 times a second)"},
                 max_sweep, {0.001, 2.0});
}

}  // namespace datmo
