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

/// Whether both names refer to the same file, which writing would overwrite.
bool isSameFile(const std::string& a, const std::string& b);

/// A bag that appears under its name only when it is complete: it is written next to it as
/// `<file>.part`, which is removed unless finish() is reached.
class OutputBag {
 public:
  /// Throws std::runtime_error that names the file if it cannot be written: a folder, no rights.
  explicit OutputBag(const std::string& file,
                     rosbag::CompressionType compression = rosbag::compression::LZ4);
  ~OutputBag();
  OutputBag(const OutputBag&) = delete;
  OutputBag& operator=(const OutputBag&) = delete;

  /// Stamps before the earliest that a bag can hold (ros::TIME_MIN) are raised to it. This and the
  /// following functions throw std::runtime_error that names the file if the disk is full.
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

  /// Copies a message of another bag unchanged, including its latched connection. Throws InputError
  /// as checkRecord().
  void copy(const rosbag::MessageInstance& message);

  /// Writes the rest of the bag, which then needs no more space. Nothing may be written after it.
  void close();

  /// Closes the bag and gives it its name.
  void finish();

 private:
  /// Deletes a bag if it can be closed, which fails on a full disk.
  struct Closing {
    void operator()(rosbag::Bag* bag) const;
  };

  void guarded(const std::function<void()>& write) const;

  std::string file_;
  std::string part_;
  std::unique_ptr<rosbag::Bag, Closing> bag_{new rosbag::Bag};
};

}  // namespace datmo
