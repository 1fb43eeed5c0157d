// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/topic_reader.h"

#include "interruption.h"

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::evaluation {

void TopicReader::fail(const std::string& location, const std::string& what) const {
  throw std::runtime_error(bag_.getFileName() + ": " + location + ": " + what);
}

void TopicReader::takeHeader(const std_msgs::Header& header) {
  if (header.stamp.isZero()) {
    throw InputError("zero_stamp", "expected the time of the measurement");
  }
  if (frame_.value_or(header.frame_id) != header.frame_id) {
    throw InputError("other_frame", "is in frame '" + header.frame_id + "', but others are in '" +
                                        *frame_ + "': expected one frame");
  }
  frame_ = header.frame_id;
}

void TopicReader::checkOnce(Stamp before, Stamp stamp) const {
  if (before == stamp) {
    fail(topic_, "two messages at " + std::to_string(stamp.seconds()) +
                     " s: expected one (a bag played in a loop cannot be scored)");
  }
}

void TopicReader::failIfInterrupted() const {
  if (interrupted()) {
    throw std::runtime_error("interrupted, no report written");
  }
}

}  // namespace datmo::evaluation
