// SPDX-License-Identifier: BSD-3-Clause
#include "bag_fault.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace datmo {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;  // for bytes with zeros among them

constexpr std::string_view kBagMagic = "#ROSBAG";

constexpr std::array<std::string_view, 2> kRos2Magics = {"SQLite format 3\0"sv, "\x89MCAP0\r\n"sv};

/// The first bytes of packed files, and the command that unpacks them.
struct Packing {
  std::string_view magic;
  std::string_view command;
};
constexpr std::array<Packing, 6> kPackings = {{{"PK\x03\x04"sv, "unzip"sv},
                                               {"\x1f\x8b"sv, "gunzip"sv},
                                               {"BZh"sv, "bunzip2"sv},
                                               {"\xfd"
                                                "7zXZ\0"sv,
                                                "unxz"sv},
                                               {"\x28\xb5\x2f\xfd"sv, "unzstd"sv},
                                               {"7z\xbc\xaf\x27\x1c"sv, "7z x"sv}}};

constexpr std::size_t kHeadSize = 16;  ///< bytes, of the longest one

/// Lists the bags of a folder, for a message.
constexpr std::size_t kMaxNames = 3;

bool startsWith(std::string_view text, std::string_view head) {
  return text.substr(0, head.size()) == head;
}

bool endsWith(std::string_view text, std::string_view tail) {
  return text.size() >= tail.size() && text.substr(text.size() - tail.size()) == tail;
}

std::string ros2Fault(const std::string& path) {
  return "is a recording of ROS 2, expected a bag of ROS 1; 'pip install rosbags' and"
         " 'rosbags-convert --src " +
         path + " --dst ros1.bag' convert it";
}

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;  // then there is nothing to list
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool isOfRos2(const std::string& name) {
  return name == "metadata.yaml" || endsWith(name, ".db3") || endsWith(name, ".mcap");
}

std::string folderFault(const std::string& folder) {
  const std::vector<std::string> names = namesIn(folder);
  if (std::any_of(names.begin(), names.end(), isOfRos2)) {
    return ros2Fault(folder);
  }
  std::string fault = "is a folder, expected a bag";
  std::size_t bags = 0;
  for (const std::string& name : names) {
    if (endsWith(name, ".bag") && bags++ < kMaxNames) {
      fault += (bags == 1 ? "; it holds " : ", ") + name;
    }
  }
  if (bags > 1) {
    fault += std::string(bags > kMaxNames ? ", ..." : "") +
             "; 'rosrun datmo_fusion merge_bags' merges a recording's parts into one bag";
  }
  return fault;
}

std::string contentFault(const std::string& file) {
  std::string head(kHeadSize, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  if (head.empty()) {
    return "is empty (0 bytes), expected a bag";
  }
  if (startsWith(head, kBagVersion)) {
    return "";
  }
  if (startsWith(head, kBagMagic)) {
    return "is not of bag format 2.0, expected '#ROSBAG V2.0' as its first line, which rosbag "
           "writes since 2010";
  }
  for (const std::string_view magic : kRos2Magics) {
    if (startsWith(head, magic)) {
      return ros2Fault(file);
    }
  }
  for (const Packing& packing : kPackings) {
    if (startsWith(head, packing.magic)) {
      return "is compressed, expected a bag; '" + std::string(packing.command) + " " + file +
             "' unpacks it";
    }
  }
  return "is not a bag, expected a file that begins with " + std::string(kBagMagic);
}

}  // namespace

std::string bagFault(const std::string& file) {
  std::error_code ignored;  // if this cannot be determined, it does not exist
  const fs::file_status status = fs::status(file, ignored);
  if (!fs::exists(status)) {
    return "no such file";
  }
  if (fs::is_directory(status)) {
    return folderFault(file);
  }
  if (!fs::is_regular_file(status)) {
    return "is a pipe or a device, expected a file: a bag's index is at its end";
  }
  if (access(file.c_str(), R_OK) != 0) {
    return "no permission to read it; 'chmod u+r " + file + "' by its owner grants it";
  }
  return contentFault(file);
}

}  // namespace datmo
