// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <boost/array.hpp>
#include <datmo_fusion/EarthFrame.h>
#include <datmo_fusion/Risk.h>
#include <datmo_fusion/StationTrack.h>

#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/TwistWithCovariance.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Whether a matrix (row by row, `size` x `size`) is a covariance: finite, symmetric and without
/// negative eigenvalues beyond rounding.
bool isCovariance(const double* values, std::size_t size);

namespace detail {

/// Visits all fields of a message, as listed by ROS's serialization, and records the first one that
/// is unusable for receivers.
class FieldCheck {
 public:
  /// What is wrong; empty: no fault.
  const std::string& fault() const { return fault_; }

  /// Called by ROS's serializers for each field.
  template <typename Field>
  void next(const Field& field) {
    if constexpr (std::is_floating_point_v<Field>) {
      number(field);
    } else if constexpr (ros::message_traits::IsMessage<Field>::value) {
      message(field);
    }
  }

  template <typename Element, typename Allocator>
  void next(const std::vector<Element, Allocator>& elements) {
    all(elements);
  }

  template <typename Element, std::size_t count>
  void next(const boost::array<Element, count>& elements) {
    all(elements);
  }

  template <typename Message>
  void message(const Message& content) {
    if constexpr (std::is_same_v<Message, sensor_msgs::LaserScan>) {
      // Ranges may be NaN (no measurement), but not the limits and angles of the beams.
      for (const float value :
           {content.angle_min, content.angle_max, content.angle_increment, content.time_increment,
            content.scan_time, content.range_min, content.range_max}) {
        number(value);
      }
    } else {
      const bool was_open = open_;
      open_ = open_ || kMayBeInfinite<Message>;
      checkCovariances(content);
      ros::serialization::Serializer<Message>::write(*this, content);
      open_ = was_open;
    }
  }

 private:
  /// Messages whose definitions give infinity a meaning: a side that was not seen, a contact that
  /// does not happen.
  template <typename Message>
  static constexpr bool kMayBeInfinite =
      std::is_same_v<Message, ObjectMessage> || std::is_same_v<Message, datmo_fusion::Risk>;

  template <typename Elements>
  void all(const Elements& elements) {
    using Element = typename Elements::value_type;
    if constexpr (std::is_floating_point_v<Element> ||
                  ros::message_traits::IsMessage<Element>::value) {
      for (const Element& element : elements) {
        next(element);
      }
    }
  }

  void number(double value) {
    if (std::isnan(value) || (std::isinf(value) && !open_)) {
      note("a number that is " + std::to_string(value));
    }
  }

  template <typename Message>
  void checkCovariances(const Message& /*without*/) {}
  void checkCovariances(const geometry_msgs::PoseWithCovariance& pose) {
    covariance(pose.covariance.data(), 6);
  }
  void checkCovariances(const geometry_msgs::TwistWithCovariance& twist) {
    covariance(twist.covariance.data(), 6);
  }
  void checkCovariances(const TrackMessage& track) { covariance(track.covariance.data(), 6); }
  void checkCovariances(const ObjectMessage& object) {
    covariance(object.position_covariance.data(), 2);
    covariance(object.velocity_covariance.data(), 2);
  }
  void checkCovariances(const datmo_fusion::EarthFrame& frame) {
    covariance(frame.covariance.data(), 3);
  }
  void checkCovariances(const datmo_fusion::StationTrack& track) {
    covariance(track.covariance.data(), 4);
  }

  void covariance(const double* values, std::size_t size) {
    if (!isCovariance(values, size)) {
      note("a covariance that is not positive semidefinite");
    }
  }

  void note(const std::string& fault) {
    if (fault_.empty()) {
      fault_ = fault;
    }
  }

  bool open_ = false;  ///< infinity has a meaning here
  std::string fault_;
};

}  // namespace detail

/// Returns what makes a message unusable for receivers: NaN, infinity without a meaning, an invalid
/// covariance. Empty: no fault.
template <typename Message>
std::string contentFault(const Message& message) {
  detail::FieldCheck check;
  check.message(message);
  return check.fault();
}

/// A message to be published, without its type.
struct OutputContent {
  std::optional<Stamp> stamp;  ///< none for a message without header
  std::string fault;           ///< contentFault
};

/// Check of one output: an unusable message is not published but counted (`bad_output`), and the
/// stage that made it is reset.
class OutputCheck {
 public:
  /// `monitor` must outlive it.
  OutputCheck(std::string topic, StageMonitor& monitor);

  /// Whether it may be published. Its stamp may decrease only after a reset of the stage, and must
  /// not be ahead of all inputs of the stage.
  bool passes(const OutputContent& content);

 private:
  std::string faultOf(const OutputContent& content) const;

  std::string topic_;
  StageMonitor& monitor_;
  std::optional<Stamp> newest_;
  std::uint64_t resets_ = 0;  ///< number of resets of the stage when it was published
};

}  // namespace datmo
