// SPDX-License-Identifier: BSD-3-Clause
#include "output_bag.h"

#include <filesystem>
#include <stdexcept>

#include "whole_file.h"

#include <rosbag/exceptions.h>
#include <rosbag/message_instance.h>

namespace datmo {

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code not_there;  // then they are not the same, unless they are spelled the same
  return a == b || std::filesystem::equivalent(a, b, not_there);
}

OutputBag::OutputBag(const std::string& file, rosbag::CompressionType compression)
    : file_(file), part_(file + ".part") {
  checkWritable(file_);
  try {
    bag_.open(part_, rosbag::bagmode::Write);
    bag_.setCompression(compression);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(file_ + ": cannot be written (" + error.what() + ")");
  }
}

OutputBag::~OutputBag() {
  // After finish() there is none. A bag that is still open closes into a file without a name.
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputBag::copy(const rosbag::MessageInstance& message) {
  bag_.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
}

void OutputBag::finish() {
  try {
    bag_.close();
    std::filesystem::rename(part_, file_);
  } catch (const std::exception& error) {
    throw std::runtime_error(file_ + ": cannot be written (" + error.what() + ")");
  }
}

}  // namespace datmo
