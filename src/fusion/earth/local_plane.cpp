// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/local_plane.h"

#include <cmath>

namespace datmo {

namespace {

// WGS 84.
constexpr double kSemiMajor = 6378137.0;  // m
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

constexpr double kHighest = 1e5;  // m: no vehicle is higher

/// Iterations of the latitude; each gains more than two digits near the surface.
constexpr int kIterations = 6;

Eigen::Vector3d toEarthFixed(const GeodeticPosition& position) {
  const double sin_latitude = std::sin(position.latitude);
  const double cos_latitude = std::cos(position.latitude);
  const double normal = kSemiMajor / std::sqrt(1.0 - kEccentricity2 * sin_latitude * sin_latitude);
  const double from_axis = (normal + position.altitude) * cos_latitude;
  return {from_axis * std::cos(position.longitude), from_axis * std::sin(position.longitude),
          (normal * (1.0 - kEccentricity2) + position.altitude) * sin_latitude};
}

GeodeticPosition fromEarthFixed(const Eigen::Vector3d& point) {
  const double from_axis = point.head<2>().norm();
  GeodeticPosition position;
  position.longitude = std::atan2(point.y(), point.x());
  position.latitude = std::atan2(point.z(), from_axis * (1.0 - kEccentricity2));
  for (int i = 0; i < kIterations; ++i) {
    const double sin_latitude = std::sin(position.latitude);
    const double normal =
        kSemiMajor / std::sqrt(1.0 - kEccentricity2 * sin_latitude * sin_latitude);
    position.latitude = std::atan2(point.z() + kEccentricity2 * normal * sin_latitude, from_axis);
  }
  return position;
}

}  // namespace

bool isValid(const GeodeticPosition& position) {
  return std::abs(position.latitude) <= 0.5 * kPi && std::abs(position.longitude) <= 2.0 * kPi &&
         std::abs(position.altitude) <= kHighest;
}

LocalPlane::LocalPlane(const GeodeticPosition& datum)
    : datum_(datum), origin_(toEarthFixed(datum)) {
  const double sin_lat = std::sin(datum.latitude);
  const double cos_lat = std::cos(datum.latitude);
  const double sin_lon = std::sin(datum.longitude);
  const double cos_lon = std::cos(datum.longitude);
  axes_ << -sin_lon, cos_lon, 0.0,                      //
      -sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat,  //
      cos_lat * cos_lon, cos_lat * sin_lon, sin_lat;
}

Point2 LocalPlane::toPlane(const GeodeticPosition& position) const {
  return (axes_ * (toEarthFixed(position) - origin_)).head<2>();
}

GeodeticPosition LocalPlane::toGeodetic(const Point2& point) const {
  GeodeticPosition position = fromEarthFixed(origin_ + axes_.topRows<2>().transpose() * point);
  position.altitude = datum_.altitude;
  return position;
}

}  // namespace datmo
