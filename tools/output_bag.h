// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <boost/make_shared.hpp>

#include <ros/message_traits.h>
#include <ros/time.h>
#include <rosbag/bag.h>

namespace datmo {

/// Whether both names lead to one file, which writing the one would then take from the other.
bool isSameFile(const std::string& a, const std::string& b);

/// A bag that appears under its name when it is complete, and not at all otherwise: it is written
/// beside it as `<file>.part`, which goes away unless finish() is reached.
class OutputBag {
 public:
  /// Throws std::runtime_error that names the file if it cannot be written: a folder, no rights.
  explicit OutputBag(const std::string& file,
                     rosbag::CompressionType compression = rosbag::compression::LZ4);
  ~OutputBag();
  OutputBag(const OutputBag&) = delete;
  OutputBag& operator=(const OutputBag&) = delete;

  /// Stamps before the first that a bag can hold (ros::TIME_MIN) are raised to it. This and the
  /// following throw std::runtime_error that names the file when the disk is full.
  template <typename Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message) {
    guarded([&] { bag_->write(topic, time < ros::TIME_MIN ? ros::TIME_MIN : time, message); });
  }

  /// The same for a latched topic: players publish it latched again.
  template <typename Message>
  void writeLatched(const std::string& topic, const ros::Time& time, const Message& message) {
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["latching"] = "1";
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    guarded([&] { bag_->write(topic, time, message, header); });
  }

  /// A message as it stands in another bag, latched connection and all.
  void copy(const rosbag::MessageInstance& message);

  /// Closes the bag and gives it its name.
  void finish();

 private:
  /// Deletes a bag if it can be closed: on a full disk it cannot.
  struct Closing {
    void operator()(rosbag::Bag* bag) const;
  };

  void guarded(const std::function<void()>& write) const;

  std::string file_;
  std::string part_;
  std::unique_ptr<rosbag::Bag, Closing> bag_{new rosbag::Bag};
};

}  // namespace datmo
