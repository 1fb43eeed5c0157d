// SPDX-License-Identifier: BSD-3-Clause
#include "output_bag.h"

#include <filesystem>
#include <stdexcept>

#include "message_record.h"

#include <rosbag/exceptions.h>
#include <rosbag/message_instance.h>

#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code not_there;  // then they are different files unless the names are equal
  return a == b || std::filesystem::equivalent(a, b, not_there);
}

void OutputBag::Closing::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
    delete bag;
  } catch (const std::exception&) {
    // The disk is full: rosbag's destructor would try again and end the program. The bag is kept
    // here, because unreferenced memory would be reported as a leak.
    [[maybe_unused]] static rosbag::Bag* unclosed = nullptr;
    unclosed = bag;
  }
}

OutputBag::OutputBag(const std::string& file, rosbag::CompressionType compression)
    : file_(file), part_(file + ".part") {
  checkWritable(file_);
  try {
    bag_->open(part_, rosbag::bagmode::Write);
    bag_->setCompression(compression);
  } catch (const rosbag::BagException& error) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw std::runtime_error(file_ + ": cannot be written (" + error.what() + ")");
  }
}

OutputBag::~OutputBag() {
  // A bag that is still open is closed into a file without a name. After finish() there is none.
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputBag::copy(const rosbag::MessageInstance& message) {
  checkRecord(message);
  guarded([&] {
    bag_->write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
  });
}

void OutputBag::close() {
  guarded([this] { bag_->close(); });
}

void OutputBag::finish() {
  close();
  guarded([this] { std::filesystem::rename(part_, file_); });
}

void OutputBag::guarded(const std::function<void()>& write) const {
  try {
    write();
  } catch (const std::exception& error) {
    throw std::runtime_error(file_ + ": cannot be written (" + error.what() +
                             "): expected free space on its disk");
  }
}

}  // namespace datmo
