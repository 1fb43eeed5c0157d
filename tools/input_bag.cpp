// SPDX-License-Identifier: BSD-3-Clause
#include "input_bag.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "bag_fault.h"
#include "bag_index.h"
#include "message_record.h"

#include <rosbag/exceptions.h>
#include <rosbag/view.h>

namespace datmo {

namespace {

[[noreturn]] void failForIndex(const std::string& file) {
  throw std::runtime_error(file +
                           ": has no index: it was cut short, or is still being written;"
                           " 'rosbag reindex " +
                           file + "' recovers its messages");
}

}  // namespace

void openInput(const std::string& file, rosbag::Bag& bag) {
  const std::string fault = bagFault(file);
  if (!fault.empty()) {
    throw std::runtime_error(file + ": " + fault);
  }
  if (!hasPossibleIndex(file)) {
    failForIndex(file);
  }
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagException&) {  // any part of the index cannot be read
    failForIndex(file);
  } catch (const std::exception& error) {  // from rosbag, and from ros::Time for an invalid stamp
    throw std::runtime_error(file + ": cannot be read as a bag (" + error.what() + ")");
  }
  if (rosbag::View(bag).size() == 0) {
    throw std::runtime_error(file + ": holds no message, expected a recording");
  }
}

std::vector<std::string> topicsOf(const rosbag::Bag& bag) {
  std::set<std::string> topics;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    topics.insert(connection->topic + " (" + connection->datatype + ")");
  }
  return {topics.begin(), topics.end()};
}

bool holdsTopic(const rosbag::Bag& bag, const std::string& topic) {
  return rosbag::View(bag, rosbag::TopicQuery(topic)).size() > 0;
}

bool holdsTopic(const rosbag::Bag& bag, const std::string& topic, const std::string& type) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  const std::vector<const rosbag::ConnectionInfo*> connections = view.getConnections();
  return view.size() > 0 && std::all_of(connections.begin(), connections.end(),
                                        [&](const auto* each) { return each->datatype == type; });
}

std::vector<std::uint8_t> bytesOf(const rosbag::MessageInstance& message) {
  checkRecord(message);
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  message.write(stream);
  return bytes;
}

void failForType(const rosbag::MessageInstance& message, const std::string& expected) {
  const std::string& type = message.getDataType();
  const std::string found = message.getTopic() + " is ";
  if (type == expected) {
    throw InputError("other_version",
                     found + "another version of " + type +
                         ", expected ours; doc/interfaces.md says what 'rosbag fix' converts");
  }
  throw InputError("wrong_type", found + type + ", expected " + expected);
}

void failForTopic(const rosbag::Bag& bag, const std::string& missing) {
  std::string message = bag.getFileName() + ": " + missing + "; the bag holds:";
  for (const std::string& topic : topicsOf(bag)) {
    message += "\n  " + topic;
  }
  throw std::runtime_error(message);
}

}  // namespace datmo
