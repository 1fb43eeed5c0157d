#include "input_bag.h"

#include <filesystem>
#include <set>
#include <stdexcept>

#include <rosbag/exceptions.h>
#include <rosbag/view.h>

namespace datmo {

void openInput(const std::string& file, rosbag::Bag& bag) {
  if (!std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(file + ": no such file");
  }
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(file +
                             ": has no index, so it was cut short while it was written;"
                             " 'rosbag reindex' saves what is there");
  } catch (const std::exception& error) {  // of rosbag, and of ros::Time for a broken stamp
    throw std::runtime_error(file + ": cannot be read as a bag (" + error.what() + ")");
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

void failForTopic(const rosbag::Bag& bag, const std::string& missing) {
  std::string message = bag.getFileName() + ": " + missing + "; the bag holds:";
  for (const std::string& topic : topicsOf(bag)) {
    message += "\n  " + topic;
  }
  throw std::runtime_error(message);
}

}  // namespace datmo
