// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "marker_parts.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/display/marker_colors.h"
#include "datmo_fusion/ros/display/markers.h"

namespace datmo {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// Parts of a car as shares of its length (from the rear), width and height, like a common
/// hatchback.
constexpr double kFloor = 0.12;      // of the height
constexpr double kBelt = 0.6;        // of the height: lower edge of the windows
constexpr double kCabinRear = 0.06;  // of the length
constexpr double kCabinFront = 0.68;
constexpr double kCabinWidth = 0.86;
constexpr double kRoofRear = 0.12;
constexpr double kRoofFront = 0.55;
constexpr double kWindowTop = 0.93;  // of the height
constexpr double kRearAxle = 0.2;
constexpr double kFrontAxle = 0.8;
constexpr double kWheelDiameter = 0.4;  // of the height
constexpr double kWheelWidth = 0.12;    // of the width
constexpr double kLamp = 0.02;          // of the length
constexpr double kLampWidth = 0.2;      // of the width

const std_msgs::ColorRGBA kPaint = colorOfOwnVehicle();
const std_msgs::ColorRGBA kGlass = color(0.1F, 0.14F, 0.2F);
const std_msgs::ColorRGBA kTire = color(0.05F, 0.05F, 0.05F);
const std_msgs::ColorRGBA kHeadLamp = color(1.0F, 1.0F, 0.85F);
const std_msgs::ColorRGBA kTailLamp = color(0.8F, 0.0F, 0.0F);

/// Assembles the parts; each position is a share of the body's length, half width and height.
class Body {
 public:
  Body(std_msgs::Header header, const VehicleBodyOptions& options)
      : header_(std::move(header)), options_(options) {
    header_.stamp = ros::Time();  // with frame_locked: follows the latest position of its frame
  }

  /// From rear to front, `width` wide around `side` (-1 right, 1 left), from bottom to top.
  struct Extent {
    double rear, front, side, width, bottom, top;
  };

  void addBox(const Extent& extent, const std_msgs::ColorRGBA& color) {
    Marker box = part(Marker::CUBE, color);
    const double rear = -options_.rear_overhang;
    box.pose.position = pointAt(rear + 0.5 * (extent.rear + extent.front) * options_.length,
                                extent.side * 0.5 * options_.width,
                                0.5 * (extent.bottom + extent.top) * options_.height);
    box.scale.x = (extent.front - extent.rear) * options_.length;
    box.scale.y = extent.width * options_.width;
    box.scale.z = (extent.top - extent.bottom) * options_.height;
    markers_.markers.push_back(box);
  }

  void addWheel(double axle, double side) {
    Marker wheel = part(Marker::CYLINDER, kTire);
    const double diameter = kWheelDiameter * options_.height;
    wheel.pose.position =
        pointAt(-options_.rear_overhang + axle * options_.length,
                side * (1.0 - kWheelWidth) * 0.5 * options_.width, 0.5 * diameter);
    wheel.pose.orientation.x = std::sin(kPi / 4.0);  // lies on its side
    wheel.pose.orientation.w = std::cos(kPi / 4.0);
    wheel.scale.x = diameter;
    wheel.scale.y = diameter;
    wheel.scale.z = kWheelWidth * options_.width;
    markers_.markers.push_back(wheel);
  }

  MarkerArray markers() const { return markers_; }

 private:
  Marker part(int type, const std_msgs::ColorRGBA& color) const {
    Marker marker = makeMarker(header_, "vehicle", type);
    marker.id = static_cast<int>(markers_.markers.size());
    marker.frame_locked = true;
    marker.color = color;
    return marker;
  }

  std_msgs::Header header_;
  VehicleBodyOptions options_;
  MarkerArray markers_;
};

}  // namespace

void VehicleBodyOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "length of the vehicle as drawn"}, length, {0.1, 30.0});
  visitor.number({"width", "m", "width of the vehicle as drawn"}, width, {0.1, 5.0});
  visitor.number({"rear_overhang", "m", "from its rear end to the base frame"}, rear_overhang,
                 {0.0, 10.0});
  visitor.number({"height", "m", "height of its roof above the ground"}, height, {0.05, 10.0});
}

MarkerArray vehicleMarkers(const std_msgs::Header& scan, const VehicleBodyOptions& options) {
  Body body(scan, options);
  body.addBox({0.0, 1.0, 0.0, 1.0, kFloor, kBelt}, kPaint);
  body.addBox({kCabinRear, kCabinFront, 0.0, kCabinWidth, kBelt, kWindowTop}, kGlass);
  body.addBox({kRoofRear, kRoofFront, 0.0, kCabinWidth, kWindowTop, 1.0}, kPaint);
  for (const double side : {-1.0, 1.0}) {
    body.addWheel(kRearAxle, side);
    body.addWheel(kFrontAxle, side);
    const double lamp = side * (1.0 - kLampWidth);
    body.addBox({1.0 - kLamp, 1.0 + kLamp, lamp, kLampWidth, 0.5 * kBelt, kBelt}, kHeadLamp);
    body.addBox({-kLamp, kLamp, lamp, kLampWidth, 0.5 * kBelt, kBelt}, kTailLamp);
  }
  return body.markers();
}

}  // namespace datmo
