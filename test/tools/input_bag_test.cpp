// SPDX-License-Identifier: BSD-3-Clause
#include "input_bag.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "bag_fault.h"
#include "output_bag.h"
#include "ros/raw_message.h"
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "datmo_fusion/ros/whole_file.h"

namespace datmo::input_bag_test {
namespace {

namespace fs = std::filesystem;

constexpr int kMessages = 200;

std::string messageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// A bag in its own folder, in many small chunks.
class InputBag : public testing::Test {
 protected:
  InputBag() {
    std::string name = (fs::temp_directory_path() / "input_bag_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    file_ = folder_ / "drive.bag";
  }
  ~InputBag() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  void writeBag(rosbag::CompressionType compression = rosbag::compression::Uncompressed,
                int messages = kMessages) const {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(1024);
    for (int i = 0; i < messages; ++i) {
      std_msgs::String text;
      text.data = "number " + std::to_string(i);
      bag.write("/text", ros::Time(1.0 + i), text);
    }
  }

  void writeBytes(const std::string& bytes) const { std::ofstream(file_) << bytes; }

  /// Returns the message about the file, without its name.
  std::string refusal(const std::string& file) const {
    const std::string message = messageOf([&] {
      rosbag::Bag bag;
      openInput(file, bag);
    });
    EXPECT_EQ(message.substr(0, file.size() + 2), file + ": ");
    return message.substr(std::min(message.size(), file.size() + 2));
  }
  std::string refusal() const { return refusal(file_); }

  void expectRefused(const std::string& part) const {
    EXPECT_NE(refusal().find(part), std::string::npos) << refusal();
  }

  fs::path folder_;
  fs::path file_;
};

TEST_F(InputBag, EveryCompressionIsRead) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    writeBag(compression);
    rosbag::Bag bag;
    openInput(file_, bag);
    EXPECT_EQ(topicsOf(bag), std::vector<std::string>{"/text (std_msgs/String)"});
    EXPECT_EQ(bagFault(file_), "");
  }
}

TEST_F(InputBag, MissingAndSpecialFiles) {
  EXPECT_EQ(refusal(), "no such file");
  EXPECT_EQ(refusal(folder_), "is a folder, expected a bag");
  mkfifo(file_.c_str(), 0600);
  expectRefused("is a pipe or a device");
}

TEST_F(InputBag, BagsInAFolderAreNamed) {
  for (int i = 0; i < 5; ++i) {
    std::ofstream(folder_ / ("drive_" + std::to_string(i) + ".bag")) << "";
  }
  EXPECT_EQ(refusal(folder_),
            "is a folder, expected a bag; it holds drive_0.bag, drive_1.bag, drive_2.bag, ...; "
            "'rosrun datmo_fusion merge_bags' merges a recording's parts into one bag");
}

TEST_F(InputBag, FilesThatAreNoBags) {
  writeBytes("");
  expectRefused("is empty (0 bytes)");
  writeBytes("not a bag");
  expectRefused("is not a bag, expected a file that begins with #ROSBAG");
  writeBytes("PK\x03\x04 and so on");
  expectRefused("is compressed, expected a bag; 'unzip " + file_.string() + "' unpacks it");
  writeBag(rosbag::compression::Uncompressed, 0);
  expectRefused("holds no message");
}

TEST_F(InputBag, OtherFormatsAreRefusedBeforeTheirLengthsAreBelieved) {
  writeBag();
  std::ifstream stream(file_, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  std::ostringstream rest;
  rest << stream.rdbuf();
  // rosbag takes all but the first two for 2.0, too.
  for (const char* version : {"V1.2\n", "V3.0\n", "V2.00\n", "V1.100\n", " V2.0\n", "V2.0"}) {
    writeBytes(std::string("#ROSBAG ") + version + rest.str());
    expectRefused("is not of bag format 2.0, expected '#ROSBAG V2.0' as its first line");
  }
}

TEST_F(InputBag, RecordingsOfRos2) {
  writeBytes(std::string("SQLite format 3\0 and so on", 26));
  expectRefused("'rosbags-convert --src " + file_.string() + " --dst ros1.bag'");
  writeBytes("\x89MCAP0\r\n and so on");
  expectRefused("is a recording of ROS 2");
  std::ofstream(folder_ / "metadata.yaml") << "";
  EXPECT_NE(refusal(folder_).find("is a recording of ROS 2"), std::string::npos);
}

TEST_F(InputBag, TruncatedBags) {
  for (const double share : {0.01, 0.3, 0.9, 0.999}) {
    writeBag();
    fs::resize_file(file_,
                    static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(file_))));
    expectRefused("has no index: it was cut short");
    expectRefused("'rosbag reindex " + file_.string() + "'");
  }
}

TEST_F(InputBag, BagWithoutPermission) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may read every file";
  }
  writeBag();
  fs::permissions(file_, fs::perms::none);
  expectRefused("no permission to read it");
}

TEST_F(InputBag, OutputsThatCannotBeWrittenAreReportedAtTheStart) {
  const std::string nowhere = (folder_ / "nowhere" / "out.bag").string();
  EXPECT_EQ(messageOf([&] { OutputBag bag(nowhere); }),
            nowhere + ": cannot be written (no folder " + (folder_ / "nowhere").string() + ")");
  EXPECT_EQ(messageOf([&] { OutputBag bag(folder_.string()); }),
            folder_.string() + ": is a folder, expected the name of a file");
  checkWritable(file_);
  const fs::path here = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(messageOf([] { checkWritable("out.bag"); }), "");
  fs::current_path(here);
}

TEST_F(InputBag, APipeIsNotReplacedByAnOutput) {
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_EQ(messageOf([&] { OutputBag bag(file_.string()); }),
            file_.string() + ": is a pipe or a device, expected the name of a file");
  EXPECT_TRUE(fs::is_fifo(file_));
}

TEST_F(InputBag, AnyBagTruncatedAtItsEndIsRepairedByReindex) {
  for (const std::uintmax_t cut : {1U, 10U, 100U, 300U, 1000U, 3000U}) {
    writeBag();
    fs::resize_file(file_, fs::file_size(file_) - cut);
    SCOPED_TRACE(cut);
    expectRefused("'rosbag reindex " + file_.string() + "'");
  }
}

TEST_F(InputBag, OutputInAFolderWithoutPermission) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may write in every folder";
  }
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(
      messageOf([&] { checkWritable(file_); }),
      file_.string() + ": cannot be written (no permission to write in " + folder_.string() + ")");
  fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(InputBag, AFullDiskIsReportedAndLeavesNoBag) {
  const auto write = [this] {
    OutputBag output(file_);
    std_msgs::String text;
    text.data.assign(1U << 20U, 'a');
    output.write("/text", ros::Time(1.0), text);
    output.finish();
  };
  fs::create_symlink("/dev/full", file_.string() + ".part");
  EXPECT_EQ(messageOf(write).rfind(file_.string() + ": cannot be written (", 0), 0U)
      << messageOf(write);
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_FALSE(fs::exists(fs::symlink_status(file_.string() + ".part")));
}

/// Reads a map of which only these bytes are there.
std::string readingOf(const std::string& file, const RawMessage<nav_msgs::OccupancyGrid>& raw) {
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.write("/map", ros::Time(7.5), raw);
  }
  rosbag::Bag bag(file);
  rosbag::View view(bag);
  try {
    return std::to_string(read<nav_msgs::OccupancyGrid>(*view.begin())->data.size());
  } catch (const InputError& error) {
    return error.reason() + ": " + error.what();
  }
}

TEST_F(InputBag, AnotherTypeAndAnotherVersionOfATypeAreNamed) {
  const auto written_as = [this](const std::string& type, const std::string& checksum) {
    const nav_msgs::OccupancyGrid map;
    const auto header = boost::make_shared<ros::M_string>();
    *header = {{"type", type},
               {"md5sum", checksum},
               {"message_definition", ros::message_traits::definition(map)}};
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    bag.write("/map", ros::Time(7.5), map, header);
  };
  const auto reading = [this] {
    return messageOf([this] {
      rosbag::Bag bag(file_);
      rosbag::View view(bag);
      read<nav_msgs::OccupancyGrid>(*view.begin());
    });
  };
  written_as("nav_msgs/OccupancyGrid", ros::message_traits::md5sum<nav_msgs::OccupancyGrid>());
  EXPECT_EQ(reading(), "");
  written_as("nav_msgs/OccupancyGrid", std::string(32, '0'));
  EXPECT_EQ(reading(),
            "/map is another version of nav_msgs/OccupancyGrid, expected ours; doc/interfaces.md "
            "says what 'rosbag fix' converts");
  written_as("nav_msgs/Grid", std::string(32, '0'));
  EXPECT_EQ(reading(), "/map is nav_msgs/Grid, expected nav_msgs/OccupancyGrid");
}

TEST_F(InputBag, AMessageIsReadAsItWasWritten) {
  nav_msgs::OccupancyGrid map;
  map.data.assign(9, 100);
  EXPECT_EQ(readingOf(file_, toRaw(map)), "9");
}

TEST_F(InputBag, ATruncatedMessageIsNamedByTopicAndTime) {
  nav_msgs::OccupancyGrid map;
  map.data.assign(9, 100);
  auto raw = toRaw(map);
  raw.bytes.resize(40);
  const std::string reading = readingOf(file_, raw);
  EXPECT_EQ(
      reading.find(
          "undecodable_message: /map at 7.500000 s: expected a complete nav_msgs/OccupancyGrid"),
      0U)
      << reading;
}

TEST_F(InputBag, ACorruptLengthIsDetectedBeforeAllocation) {
  nav_msgs::OccupancyGrid map;
  map.data.assign(9, 100);
  auto raw = toRaw(map);
  const std::size_t length_at = raw.bytes.size() - 9 - 4;
  std::fill_n(raw.bytes.begin() + static_cast<std::ptrdiff_t>(length_at), 4, 0xFF);
  const std::string reading = readingOf(file_, raw);
  EXPECT_NE(reading.find("an array of 4294967295 elements, but only 9 bytes are left"),
            std::string::npos)
      << reading;
}

}  // namespace
}  // namespace datmo::input_bag_test
